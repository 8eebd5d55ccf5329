// SPDX-License-Identifier: MIT
/// @file
/// Pictures.
///
/// - Shapes: rows of pixels, row by row.
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

/// Row 0 is the top; pixel (x, y) at y * width + x.
struct Image {
    int width = 0;              ///< pixels
    int height = 0;             ///< pixels
    std::vector<Color> pixels;  ///< width * height
};

/// Writes an 8-bit RGB PNG, atomically. Throws OutputError.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace dynamic_filter::io
