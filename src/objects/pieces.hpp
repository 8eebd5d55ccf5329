// SPDX-License-Identifier: MIT
/// Pieces of what moves in one scan.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace dynamic_filter::app {

/// Points that touch each other, as seen from above.
struct Piece {
    std::vector<std::uint32_t> points;  ///< by index, ascending
    Eigen::AlignedBox3d box;            ///< [m] in the world
};

/// Places [m] in cells that touch each other, be it at a corner, form a piece. In the order of
/// their first points.
std::vector<Piece> pieces_of(std::span<const Eigen::Vector3d> places, double cell);

/// A piece of these points.
Piece piece_of(std::span<const Eigen::Vector3d> places, std::vector<std::uint32_t> points);

}  // namespace dynamic_filter::app
