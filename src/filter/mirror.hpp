// SPDX-License-Identifier: MIT
/// A mirror or a pane that reflects beams, and which points were seen in it. A sensor reports such
/// a point behind the pane, where nothing is.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "filter/upright_planes.hpp"

namespace dynamic_filter {

constexpr float kMirrorCell = 0.25F;  ///< [m] edge of a cell of a mirror
constexpr int kMirrorAngles = 3;      ///< classes of the angle of incidence: a pane that lets beams
                                      ///< through may reflect those that graze it

/// The parts of an upright plane that reflect what lies in front of them, where the normal points.
struct Mirror {
    UprightPlane plane;
    float lowest = 0.0F;           ///< [m] height of the first row of cells
    int columns = 0, rows = 0;     ///< of cells, from `plane.from` and `lowest` on
    std::vector<bool> reflects{};  ///< by angle of incidence, row and column

    /// The cell at this place of the plane; empty if there is none.
    [[nodiscard]] std::optional<std::size_t> cell(float along, float z, int angle) const;
};

/// Where and how a line of sight crosses a plane.
struct Crossing {
    float along, z, depth;  ///< [m] place in the plane, and how far it goes on behind it
    int angle;              ///< class of the angle of incidence
};
constexpr float kBehindMirror = 0.4F;   ///< [m] nearer points may belong to the pane itself
constexpr float kDeepInMirror = 31.0F;  ///< [m] behind the plane; farther points are not looked at
/// Empty if the line of sight does not go from the front to `least` [m] or more behind the plane.
std::optional<Crossing> crossing(const UprightPlane& plane, const Point& sensor, const Point& point,
                                 float least = kBehindMirror);

/// True if a beam from `sensor` to `point` was reflected by the mirror on its way.
bool is_reflected(const Mirror& mirror, const Point& sensor, const Point& point,
                  float least = kBehindMirror);

/// True if the point lies on a part of the mirror that reflects.
bool is_on(const Mirror& mirror, const Point& point);

/// True for any of the mirrors.
bool is_reflected(const std::vector<Mirror>& mirrors, const Point& sensor, const Point& point,
                  float least = kBehindMirror);
bool is_on(const std::vector<Mirror>& mirrors, const Point& point);

}  // namespace dynamic_filter
