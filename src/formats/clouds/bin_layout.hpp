// SPDX-License-Identifier: MIT
/// How the points of .bin files are stored, which have no header that tells it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::io {

struct BinLayout {
    FieldType type = FieldType::f32;  ///< or float64; of all values
    std::vector<std::string> names;   ///< of the values of a point

    [[nodiscard]] std::size_t point_bytes() const { return size_of(type) * names.size(); }
};

/// "float32 x y z intensity".
std::string to_string(const BinLayout& layout);

/// The layouts that are tried; KITTI's is the first.
const std::vector<BinLayout>& bin_layouts();

/// The beginning of a .bin file, and the size of the whole file [bytes].
struct BinSample {
    std::vector<std::byte> head;
    std::uintmax_t size = 0;
};

/// What the contents of files tell of their layout.
struct BinChoice {
    std::optional<BinLayout> layout;  ///< empty: none of bin_layouts() is plausible
    bool is_sure = false;             ///< false: there are too few points to tell
};

/// Chooses the layout that fits the contents: coordinates of a plausible size, and points near
/// those before them in the file. KITTI's is chosen unless another one fits much better.
BinChoice choose_bin_layout(std::span<const BinSample> samples);

/// Throws InputError for a size [bytes] that is no whole number of points.
void refuse_bad_bin_size(const std::filesystem::path& file, std::size_t bytes,
                         const BinLayout& layout);

/// Reads points of a layout. Throws InputError.
Cloud read_bin(const std::filesystem::path& file, const BinLayout& layout);

}  // namespace dynamic_filter::io
