// SPDX-License-Identifier: MIT
/// Collects what a map for navigation is made of, scan by scan.
#pragma once

#include <span>
#include <vector>

#include "navigation/columns.hpp"
#include "navigation/ground.hpp"
#include "navigation/look_chooser.hpp"
#include "navigation/navigation_map.hpp"

namespace dynamic_filter::app {

class Survey {
public:
    /// `cell`: width of a cell [m].
    explicit Survey(double cell) : cell_(cell), columns_(static_cast<float>(cell)) {}

    /// Points of the sensor frame with their labels: static ones are floor and obstacles, all of
    /// them end a beam. Points without a measurement count for nothing.
    void add(const Points& points, const Labels& labels, const Pose& T_world_sensor, double stamp);
    // The parts of add(): the first scan, or place, chooses the frame of the map.
    /// `counts`: how many points each of them stands for; empty: one.
    void add_surfaces(const Points& points, const Labels& labels, const Pose& T_world_sensor,
                      std::span<const std::uint32_t> counts = {});
    void add_beams(const Points& points, const Pose& T_world_sensor);
    /// A place of the sensor between two scans that are added.
    void pass(const Eigen::Vector3d& place);
    [[nodiscard]] NavigationMap map(const Robot& robot, int storey) const {
        return navigation_map(columns_, path_, looks_, robot, storey);
    }
    /// The floor alone, for which beams are of no use.
    [[nodiscard]] Ground ground(const Robot& robot) const;
    /// The corner of cell (0, 0) in the world [m].
    [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
    [[nodiscard]] double cell() const { return cell_; }

private:
    [[nodiscard]] Pose to_map(const Pose& T_world_sensor) const;

    double cell_;
    Columns columns_;
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    Points path_;
    std::vector<Look> looks_;
    LookChooser chooser_;
};

}  // namespace dynamic_filter::app
