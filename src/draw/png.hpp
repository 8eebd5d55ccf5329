// SPDX-License-Identifier: MIT
/// @file
/// Writes pictures.
///
/// - Shapes: pixels row by row.
/// - Threads: thread-safe.
/// - Errors: OutputError.
/// - Ownership: values.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace dynamic_filter::io {

using Color = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A picture. Row 0 is the top; pixel (x, y) has the index y * width + x.
struct Image {
    int width = 0;              ///< pixels
    int height = 0;             ///< pixels
    std::vector<Color> pixels;  ///< width * height pixels
};

/// Writes an 8-bit RGB PNG file atomically. Throws OutputError.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace dynamic_filter::io
