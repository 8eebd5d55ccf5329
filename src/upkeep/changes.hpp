// SPDX-License-Identifier: MIT
/// What rests at one date and is away at another.
#pragma once

#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "geometry/world_voxel.hpp"

namespace dynamic_filter::app {

/// Points that touch each other, and rest for the whole of a drive.
struct Change {
    Eigen::AlignedBox3d box;                 ///< [m] in the world
    std::size_t scans = 0;                   ///< that have a point of it
    double first = 0.0, last = 0.0;          ///< [s] stamps of these scans
    std::vector<std::uint32_t> collected{};  ///< its points, by index among all that were added

    [[nodiscard]] std::size_t points() const { return collected.size(); }
};

/// Collects the points of one date that are away at the other. Single caller.
class ChangedPoints {
public:
    /// A point rested if it is static by the labels of its own date, `alone`; it is away at the
    /// other date if it is dynamic by those of both dates, `together`.
    void add(const io::FullScan& scan, const Labels& alone, const Labels& together);
    /// With the most points first. Specks, which poses and grazing beams leave, are no changes, nor
    /// is what rests at the other date, too: labels of one date alone, or of both, may be wrong.
    [[nodiscard]] std::vector<Change> changes(const ChangedPoints& other_date) const;
    /// The points of the changes, with all fields of the scans, x y z in the world, and a field
    /// `change`, the running number of the change from 1.
    [[nodiscard]] io::Cloud cloud(const std::vector<Change>& changes) const;

private:
    /// The share of the points' voxels in which something rests at the other date.
    [[nodiscard]] double share_at_rest(const std::vector<std::uint32_t>& points,
                                       const ChangedPoints& other_date) const;

    /// In how many scans a voxel has dynamic points.
    struct Times {
        std::uint32_t last_scan = UINT32_MAX, scans = 0;
    };
    [[nodiscard]] bool is_at_rest(const WorldVoxel& voxel) const;

    tsl::robin_set<WorldVoxel, NumbersHash> static_;
    tsl::robin_map<WorldVoxel, Times, NumbersHash> dynamic_;
    io::Cloud layout_;                // of the first scan
    std::vector<std::byte> records_;  // in that layout
    std::vector<Eigen::Vector3d> places_;
    std::vector<std::uint32_t> scans_;  // of each point
    std::vector<double> stamps_;        // of each scan
};

}  // namespace dynamic_filter::app
