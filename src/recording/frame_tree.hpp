// SPDX-License-Identifier: MIT
/// The tree of coordinate frames from /tf and /tf_static.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/poses.hpp"
#include "formats/messages/messages.hpp"

namespace dynamic_filter::io {

class FrameTree {
public:
    /// Adds a link, or its pose at another time. A frame keeps its first parent, and a static link
    /// its first pose; of poses with equal stamps, the first one is kept.
    void add(const PoseMessage& transform, bool is_static);
    void put_in_order();  ///< call it after links are added, before the functions below
    /// Forgets the poses of moving links that are older than `stamp` [s], except the two newest.
    void forget_before(double stamp);
    /// Forgets all links that move, because the clock was set back.
    void forget_moving();
    [[nodiscard]] std::size_t size() const { return links_.size(); }  ///< number of links
    [[nodiscard]] bool knows(const std::string& frame) const { return links_.contains(frame); }

    /// `frame` and its ancestors; the root is last.
    [[nodiscard]] std::vector<std::string> above(const std::string& frame) const;
    /// The frames below `frame` that are fixed to it, by name.
    [[nodiscard]] std::vector<std::string> fixed_below(const std::string& frame) const;
    /// Pose of one frame in another at a time; empty if they are not linked, or not at that time.
    [[nodiscard]] std::optional<Pose> pose(const std::string& of, const std::string& in,
                                           double stamp) const;
    /// True if a link between `frame` and its root changes over time.
    [[nodiscard]] bool moves(const std::string& frame) const;
    /// The newest time at which all moving links between `frame` and its root are known; empty if
    /// none of them moves.
    [[nodiscard]] std::optional<double> newest(const std::string& frame) const;
    /// Stamps of the link above a frame that was published most often.
    [[nodiscard]] std::vector<double> stamps_above(const std::string& frame) const;

private:
    struct Link {
        std::string parent;
        Trajectory T_parent_child;
        bool is_static = false;
    };
    [[nodiscard]] std::optional<Pose> in_root(const std::string& frame, double stamp) const;
    std::map<std::string, Link> links_;  // keys: child frame
};

}  // namespace dynamic_filter::io
