// SPDX-License-Identifier: MIT
/// A mesh of the vehicle as a mask.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

using Triangle = std::array<Point, 3>;

/// The triangles of an STL file, binary or text. Throws InputError.
std::vector<Triangle> read_stl(const std::filesystem::path& file);

/// Boxes that cover the inside of the mesh [m], in columns of 0.1 m along z, with a margin of
/// 0.1 m. Where the mesh has holes, a column reaches from its lowest to its highest triangle.
Boxes boxes_in(std::span<const Triangle> mesh);

}  // namespace dynamic_filter::io
