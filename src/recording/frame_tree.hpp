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

/// How poses of moving links are known between the times at which they were published.
struct LinkLookup {
    double gap = 1.0;  ///< [s] longest between two poses that are interpolated
    /// True: a link keeps its last pose until the next one (before the first one, it has that) if
    /// another link between the frame and its root goes farther and is published more often. That
    /// one is the motion, and this one corrects it, as map -> odom does.
    bool holds = false;
};

struct FrameReading;

class FrameTree {
public:
    /// Adds a link, or its pose at another time. A frame keeps its first parent, and a static link
    /// its first pose; of poses with equal stamps, the first one is kept. What another parent says
    /// is kept aside, for readings().
    void add(const PoseMessage& transform, bool is_static);
    void put_in_order();  ///< call it after links are added, before the functions below
    /// Takes moving links whose pose never changes for static ones, as old publishers of mounts
    /// send them.
    void fix_constant_links();
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
    /// The frames below `frame` that move in it, by name.
    [[nodiscard]] std::vector<std::string> moving_below(const std::string& frame) const;
    /// Where several authors say where a frame above `frame` is, a tree for each of them; otherwise
    /// only this one. Authors of one link are told apart by their poses.
    [[nodiscard]] std::vector<FrameReading> readings(const std::string& frame) const;
    /// Pose of one frame in another at a time; empty if they are not linked, or not at that time.
    [[nodiscard]] std::optional<Pose> pose(const std::string& of, const std::string& in,
                                           double stamp, const LinkLookup& lookup = {}) const;
    /// True if a link between `frame` and its root changes over time.
    [[nodiscard]] bool moves(const std::string& frame) const;
    /// The newest time at which all moving links between `frame` and its root are known; empty if
    /// none of them moves.
    [[nodiscard]] std::optional<double> newest(const std::string& frame) const;
    /// Stamps of the link above a frame that goes farthest, or was published most often.
    [[nodiscard]] std::vector<double> stamps_above(const std::string& frame) const;
    /// [m] How far the link above a frame that goes farthest gets from its first pose.
    [[nodiscard]] double reach_above(const std::string& frame) const;

private:
    struct Link {
        std::string parent;
        Trajectory T_parent_child;
        bool is_static = false;
        double way = 0.0;  ///< [m] length of its path

        void put_in_order();
        void add(const PoseMessage& transform);
    };
    void add_readings(const std::string& child, const Link& link,
                      std::vector<FrameReading>& readings) const;
    [[nodiscard]] std::optional<Pose> in_root(const std::string& frame, double stamp,
                                              const LinkLookup& lookup) const;
    /// The moving link above a frame that goes farthest; of equal ones, the one that was published
    /// most often. nullptr if none moves.
    [[nodiscard]] const Link* leading_link(const std::string& frame) const;
    std::map<std::string, Link> links_;  // keys: child frame
    // Links of other parents, and moving ones of frames that are static as well.
    std::map<std::string, std::vector<Link>> others_;
};

/// A tree in which each frame has one author.
struct FrameReading {
    FrameTree tree;
    std::string link{};    ///< that authors disagree about, such as "'base_link' in 'odom'"
    std::string author{};  ///< which of several authors of this link; may be empty
};

}  // namespace dynamic_filter::io
