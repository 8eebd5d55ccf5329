// SPDX-License-Identifier: MIT
/// Where the robot may drive, for a costmap.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

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

    /// Whether a scan of that stamp [s] would be taken; others come too soon after the last one.
    [[nodiscard]] bool is_due(double stamp) const;
    /// The newest scan, with the pose that the filter took.
    void add(const Scan& scan);
    /// A new world begins with the scan of that index: what was kept, and earlier scans that are
    /// still to come, belong to another one.
    void begin_world(std::size_t first_index);
    /// A square around the newest place of the robot; the rest is unknown. Nothing if there are no
    /// scans, or if no floor was seen.
    [[nodiscard]] std::optional<io::OccupancyCells> cells(const Judge& judge) const;

private:
    /// Points that each stand for several of a scan.
    struct Thinned {
        Scan scan;
        std::vector<std::uint32_t> counts;
    };
    struct Kept {
        std::shared_ptr<const Thinned> thinned;
        bool is_lasting;  // false: only until a newer one comes
        [[nodiscard]] const Scan& scan() const { return thinned->scan; }
    };
    [[nodiscard]] Thinned thinned(const Scan& scan) const;
    [[nodiscard]] Thinned united(const std::deque<Kept>& kept) const;

    GridOptions options_;
    mutable std::mutex lock_;  // guards what follows
    std::deque<Kept> kept_;    // the newest is last
    struct Place {
        Eigen::Vector3d place;
        double stamp;
    };
    std::deque<Place> path_;
    LookChooser chooser_;
    std::size_t first_index_ = 0;  // of this world
};

}  // namespace dynamic_filter::app
