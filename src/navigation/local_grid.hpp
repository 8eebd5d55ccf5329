// SPDX-License-Identifier: MIT
/// Where the robot may drive, for a costmap.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/filter.hpp"
#include "navigation/floor.hpp"
#include "navigation/look_chooser.hpp"

namespace dynamic_filter::app {

struct GridOptions {
    double radius = 20.0;  ///< [m] half the width of the grid
    double cell = 0.1;     ///< [m] width of a cell
    Robot robot{};
};

/// Keeps scans around the robot, half a metre or two seconds apart, thinned, and makes an occupancy
/// grid of them (navigation/navigation_map.hpp). Their points are judged anew each time, so that
/// the grid forgets what stood and left as soon as the filter does. Thread-safe.
class LocalGrid {
public:
    /// The verdict by the evidence so far.
    using Judge = std::function<Verdict(const Scan&)>;

    explicit LocalGrid(const GridOptions& options) : options_(options) {}

    /// The newest scan, with the pose that the filter took.
    void add(const Scan& scan);
    /// What was kept belongs to another world.
    void clear();
    /// A square around the newest place of the robot; the rest is unknown. Nothing if there are no
    /// scans, or if no floor was seen.
    [[nodiscard]] std::optional<io::OccupancyCells> cells(const Judge& judge) const;

private:
    struct Kept {
        std::shared_ptr<const Scan> scan;
        bool is_lasting;  // false: only until a newer one comes
    };
    [[nodiscard]] Scan thinned(const Scan& scan) const;
    [[nodiscard]] Scan united(const std::deque<Kept>& kept) const;

    GridOptions options_;
    mutable std::mutex lock_;  // guards what follows
    std::deque<Kept> kept_;    // the newest is last
    struct Place {
        Eigen::Vector3d place;
        double stamp;
    };
    std::deque<Place> path_;
    LookChooser chooser_;
};

}  // namespace dynamic_filter::app
