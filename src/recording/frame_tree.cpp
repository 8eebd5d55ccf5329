// SPDX-License-Identifier: MIT
#include "recording/frame_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "recording/two_authors.hpp"

namespace dynamic_filter::io {
namespace {

double way_of(const std::vector<Pose>& poses) {
    double way = 0.0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        way += (poses[i].translation() - poses[i - 1].translation()).norm();
    }
    return way;
}

/// The last pose before `stamp`; the first one if there is none before.
Pose held_pose(const Trajectory& poses, double stamp) {
    const auto after = std::upper_bound(poses.stamps.begin(), poses.stamps.end(), stamp);
    const auto last = after == poses.stamps.begin() ? after : after - 1;
    return poses.poses[static_cast<std::size_t>(last - poses.stamps.begin())];
}

}  // namespace

void FrameTree::Link::put_in_order() {
    io::put_in_order(T_parent_child);
    way = way_of(T_parent_child.poses);
}

void FrameTree::Link::add(const PoseMessage& transform) {
    T_parent_child.stamps.push_back(transform.stamp);
    T_parent_child.poses.push_back(transform.T_parent_child);
}

void FrameTree::add(const PoseMessage& transform, bool is_static) {
    const auto [it, fresh] = links_.try_emplace(transform.child);
    Link& link = it->second;
    if (fresh) {
        link.parent = transform.parent;
        link.is_static = is_static;
    }
    if (link.parent == transform.parent) {
        if (!link.is_static || fresh) link.add(transform);
        return;
    }
    if (is_static) return;
    auto& others = others_[transform.child];
    auto other = std::find_if(others.begin(), others.end(),
                              [&](const Link& l) { return l.parent == transform.parent; });
    if (other == others.end()) {
        other = others.emplace(others.end());
        other->parent = transform.parent;
    }
    other->add(transform);
}

void FrameTree::put_in_order() {
    for (auto& [child, link] : links_) link.put_in_order();
    for (auto& [child, others] : others_) {
        for (Link& link : others) link.put_in_order();
    }
}

void FrameTree::fix_constant_links() {
    const auto is_constant = [](const Link& link) {
        constexpr double kSame = 1e-6;  // [m], and of the elements of rotations
        const auto& poses = link.T_parent_child.poses;
        return std::all_of(poses.begin(), poses.end(), [&](const Pose& pose) {
            return (pose.matrix() - poses.front().matrix()).cwiseAbs().maxCoeff() < kSame;
        });
    };
    for (auto& [child, others] : others_) std::erase_if(others, is_constant);
    for (auto& [child, link] : links_) {
        auto& [stamps, poses] = link.T_parent_child;
        if (link.is_static || !is_constant(link)) continue;
        link.is_static = true;
        link.way = 0.0;
        stamps.resize(1);
        poses.resize(1);
    }
}

void FrameTree::forget_before(double stamp) {
    constexpr std::ptrdiff_t kLeast = 2;
    others_.clear();  // only whole recordings are read in several ways
    for (auto& [child, link] : links_) {
        auto& [stamps, poses] = link.T_parent_child;
        const auto old = std::lower_bound(stamps.begin(), stamps.end(), stamp) - stamps.begin();
        const auto most = static_cast<std::ptrdiff_t>(stamps.size()) - kLeast;
        const auto gone = std::min(old, most);
        if (gone <= 0) continue;
        stamps.erase(stamps.begin(), stamps.begin() + gone);
        poses.erase(poses.begin(), poses.begin() + gone);
    }
}

void FrameTree::forget_moving() {
    others_.clear();
    std::erase_if(links_, [](const auto& link) { return !link.second.is_static; });
}

std::vector<std::string> FrameTree::above(const std::string& frame) const {
    std::vector<std::string> chain{frame};
    for (auto it = links_.find(frame); it != links_.end(); it = links_.find(it->second.parent)) {
        const std::string& parent = it->second.parent;
        // The links form a cycle.
        if (std::find(chain.begin(), chain.end(), parent) != chain.end()) break;
        chain.push_back(parent);
    }
    return chain;
}

std::vector<std::string> FrameTree::fixed_below(const std::string& frame) const {
    std::vector<std::string> below;
    for (const auto& [child, own] : links_) {
        const std::vector<std::string> chain = above(child);
        const auto end = std::find(chain.begin(), chain.end(), frame);
        const bool fixed = std::all_of(chain.begin(), end, [&](const std::string& each) {
            const auto link = links_.find(each);
            return link != links_.end() && link->second.is_static;
        });
        if (end != chain.begin() && end != chain.end() && fixed) below.push_back(child);
    }
    return below;
}

std::vector<std::string> FrameTree::moving_below(const std::string& frame) const {
    std::vector<std::string> below;
    for (const auto& [child, own] : links_) {
        const std::vector<std::string> chain = above(child);
        const auto end = std::find(chain.begin(), chain.end(), frame);
        const bool moves = std::any_of(chain.begin(), end, [&](const std::string& each) {
            const auto link = links_.find(each);
            return link != links_.end() && !link->second.is_static;
        });
        if (end != chain.begin() && end != chain.end() && moves) below.push_back(child);
    }
    return below;
}

void FrameTree::add_readings(const std::string& child, const Link& link,
                             std::vector<FrameReading>& readings) const {
    const auto add = [&](Link only, const std::string& name) {
        FrameReading reading{
            .tree = *this, .link = fmt::format("'{}' in '{}'", child, only.parent), .author = name};
        reading.tree.others_.erase(child);
        only.put_in_order();
        reading.tree.links_[child] = std::move(only);
        readings.push_back(std::move(reading));
    };
    const auto split = link.is_static ? std::nullopt : split_authors(link.T_parent_child);
    if (!split) return add(link, "");
    for (std::size_t i = 0; i < split->size(); ++i) {
        Link only = link;
        only.T_parent_child = (*split)[i];
        add(std::move(only), i == 0 ? "by its first author" : "by its second author");
    }
}

std::vector<FrameReading> FrameTree::readings(const std::string& frame) const {
    for (const std::string& child : above(frame)) {
        const auto link = links_.find(child);
        if (link == links_.end()) continue;
        std::vector<FrameReading> readings;
        add_readings(child, link->second, readings);
        const auto others = others_.find(child);
        if (others != others_.end()) {
            for (const Link& other : others->second) add_readings(child, other, readings);
        }
        if (readings.size() > 1) return readings;
    }
    return {FrameReading{.tree = *this}};
}

std::optional<Pose> FrameTree::in_root(const std::string& frame, double stamp,
                                       const LinkLookup& lookup) const {
    Pose pose = Pose::Identity();
    const Link* const leading = leading_link(frame);
    const std::vector<std::string> chain = above(frame);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const Link& link = links_.at(chain[i]);
        const Trajectory& poses = link.T_parent_child;
        auto step = link.is_static ? std::optional(poses.poses.front())
                                   : pose_at(poses, stamp, lookup.gap, 0.2);
        const bool corrects = leading != nullptr && &link != leading &&
                              leading->T_parent_child.stamps.size() > poses.stamps.size();
        if (!step && lookup.holds && corrects) step = held_pose(poses, stamp);
        if (!step) return std::nullopt;
        pose = *step * pose;
    }
    return pose;
}

std::optional<Pose> FrameTree::pose(const std::string& of, const std::string& in, double stamp,
                                    const LinkLookup& lookup) const {
    if (above(of).back() != above(in).back()) return std::nullopt;
    const auto T_root_of = in_root(of, stamp, lookup), T_root_in = in_root(in, stamp, lookup);
    if (!T_root_of || !T_root_in) return std::nullopt;
    return T_root_in->inverse() * *T_root_of;
}

bool FrameTree::moves(const std::string& frame) const { return !stamps_above(frame).empty(); }

std::optional<double> FrameTree::newest(const std::string& frame) const {
    std::optional<double> newest;
    for (const std::string& child : above(frame)) {
        const auto link = links_.find(child);
        if (link == links_.end() || link->second.is_static) continue;
        const double last = link->second.T_parent_child.stamps.back();
        newest = newest ? std::min(*newest, last) : last;
    }
    return newest;
}

const FrameTree::Link* FrameTree::leading_link(const std::string& frame) const {
    const Link* leading = nullptr;
    const auto order_of = [](const Link& link) {
        return std::pair(link.way, link.T_parent_child.stamps.size());
    };
    for (const std::string& child : above(frame)) {
        const auto link = links_.find(child);
        if (link == links_.end() || link->second.is_static) continue;
        if (link->second.T_parent_child.stamps.size() < 2) continue;  // one pose is no motion
        if (leading == nullptr || order_of(link->second) > order_of(*leading)) {
            leading = &link->second;
        }
    }
    return leading;
}

double FrameTree::reach_above(const std::string& frame) const {
    const Link* const leading = leading_link(frame);
    double reach = 0.0;
    if (leading == nullptr) return reach;
    const auto& poses = leading->T_parent_child.poses;
    for (const Pose& pose : poses) {
        reach = std::max(reach, (pose.translation() - poses.front().translation()).norm());
    }
    return reach;
}

std::vector<double> FrameTree::stamps_above(const std::string& frame) const {
    const Link* const leading = leading_link(frame);
    return leading == nullptr ? std::vector<double>{} : leading->T_parent_child.stamps;
}

}  // namespace dynamic_filter::io
