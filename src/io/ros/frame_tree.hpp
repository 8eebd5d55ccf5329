// SPDX-License-Identifier: MIT
/// Coordinate frames as /tf and /tf_static link them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/io/trajectory.hpp"
#include "io/ros/messages.hpp"

namespace dynamic_filter::io {

class FrameTree {
public:
    /// A frame keeps the parent it had first.
    void add(const StampedPose& transform, bool is_static);
    void put_in_order();  ///< once all are added, before the questions below

    /// `frame` and all above it, the root last.
    [[nodiscard]] std::vector<std::string> above(const std::string& frame) const;
    /// Empty if they are not linked, or not at that time.
    [[nodiscard]] std::optional<Pose> pose(const std::string& of, const std::string& in,
                                           double stamp) const;
    /// True if a link that changes lies between `frame` and its root.
    [[nodiscard]] bool moves(const std::string& frame) const;
    /// When the links above a frame were told, one that changes most often.
    [[nodiscard]] std::vector<double> stamps_above(const std::string& frame) const;

private:
    struct Link {
        std::string parent;
        Trajectory T_parent_child;
        bool is_static = false;
    };
    [[nodiscard]] std::optional<Pose> in_root(const std::string& frame, double stamp) const;
    std::map<std::string, Link> links_;  // by child
};

}  // namespace dynamic_filter::io
