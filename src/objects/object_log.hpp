// SPDX-License-Identifier: MIT
/// The moving objects of a recording, scan by scan, with numbers that last.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "objects/object_boxes.hpp"
#include "objects/object_tracker.hpp"

namespace dynamic_filter::app {

/// An object as one scan saw it.
struct SeenObject {
    ObjectBox box;
    std::vector<Eigen::Vector3d> places{};  ///< [m] of its points in the world
};

/// A scan whose objects are known for good.
struct KnownScan {
    std::size_t scan = 0;
    std::vector<std::uint32_t> numbers{};  ///< of the object of each place, from 1; 0: none
    std::vector<SeenObject> objects{};
};

/// The measured points that move, by index: those that objects are made of. `labels` is parallel.
std::vector<std::uint32_t> moving_points(const Points& points, const Labels& labels);
/// Their places [m] in the world.
std::vector<Eigen::Vector3d> places_at(const Points& points, std::span<const std::uint32_t> indices,
                                       const Pose& T_world_sensor);

/// Follows what moves (object_tracker.hpp), and tells of each scan as soon as it is sure which of
/// its objects are no stray echoes. These are numbered in the order in which they are seen first.
/// Single caller. Memory: the scans of about two seconds, and 1 KB for each object.
class ObjectLog {
public:
    explicit ObjectLog(std::function<void(KnownScan)> tell) : tell_(std::move(tell)) {}

    /// Takes the places [m, world] of the points that move in a scan. Scans come in their order.
    void add(std::size_t scan, double stamp, std::vector<Eigen::Vector3d> places);
    /// Tells of the scans that are left.
    void finish();
    /// The number of objects so far.
    [[nodiscard]] std::size_t size() const { return numbers_.size(); }

private:
    /// A scan whose objects may still turn out to be stray echoes.
    struct Waiting {
        std::size_t scan;
        std::vector<Eigen::Vector3d> places;
        std::vector<std::uint32_t> objects;  // parallel, by the tracker's numbers
    };
    [[nodiscard]] bool is_settled(const Waiting& waiting) const;
    std::uint32_t number_of(std::uint32_t object);
    void tell_next();

    std::function<void(KnownScan)> tell_;
    ObjectTracker tracker_;
    std::deque<Waiting> waiting_;
    std::map<std::uint32_t, std::uint32_t> numbers_;  // by the tracker's
};

}  // namespace dynamic_filter::app
