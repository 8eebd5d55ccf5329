// SPDX-License-Identifier: MIT
/// The points of a run that its page has room for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/types.hpp"
#include "page/thinned_cloud.hpp"

namespace dynamic_filter::app {

/// Room on the page: 30 MB, and what a browser draws.
constexpr std::size_t kMapPoints = 500'000, kFramePoints = 1'000'000, kFrames = 400;

/// True if the page plays scan `index` of `scans` scans.
bool is_shown(std::size_t index, std::size_t scans);

/// All that the page shows of points.
struct Shown {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m] of the page, in the world
    ThinnedCloud map{kMapPoints};
    std::vector<ShownPoint> frames{};          ///< frame by frame
    std::vector<std::uint32_t> frame_begin{};  ///< one more than frames
    std::vector<std::int32_t> frame_of_scan{};
    bool has_intensity = false;
};

/// Takes as many points of the scans as the page has room for, evenly over the run, while the scans
/// are written.
class ShownScans {
public:
    /// For each point of a scan, an identifier of its voxel; kNoVoxelOfPage: no voxel.
    using VoxelsOf = std::function<std::vector<std::uint64_t>(const Scan&)>;

    /// `scans`: the indices of those that will come, in order. `recorded`: number of scans of the
    /// recording. `voxels_of` is called from several threads.
    ShownScans(const std::vector<std::size_t>& scans, std::size_t recorded, VoxelsOf voxels_of);

    /// Points of one scan. Their positions are in its own frame until they are added.
    struct Drawn {
        Pose T_world_sensor = Pose::Identity();
        std::vector<ShownPoint> map{}, frame{};
        bool has_intensity = false;
    };
    /// Chooses points of a scan. `intensity`: of all its points, or empty; `instant` too may be
    /// empty. Thread-safe.
    [[nodiscard]] Drawn draw(std::size_t scan, const io::FullScan& full, const Labels& labels,
                             const Labels& instant, const std::vector<double>& intensity) const;
    /// Takes what draw() chose of the scans, in order. One caller at a time.
    void add(std::size_t scan, Drawn drawn);
    /// All that was added; nothing is left here.
    [[nodiscard]] Shown take();

private:
    [[nodiscard]] bool is_asked(std::size_t scan) const;  // for points of the map
    [[nodiscard]] bool is_frame(std::size_t scan) const { return is_shown(scan, rows_.size()); }

    std::vector<std::uint32_t> rows_;  // of the page's path, by scan
    std::size_t stride_ = 1;           // from one row of which the map takes points to the next
    std::size_t for_map_ = 0, for_frame_ = 0;  // number of points of a scan
    VoxelsOf voxels_of_;
    Shown shown_{};
};

/// As recorded; empty where there is none.
std::vector<double> intensities(const io::Cloud& cloud);

}  // namespace dynamic_filter::app
