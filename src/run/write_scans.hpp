// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "check/company.hpp"
#include "check/continuity.hpp"
#include "check/watch.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::app {

/// Where final verdicts come from and go to.
struct ScanResults {
    /// The final verdict on a scan. Called from several threads.
    std::function<Verdict(std::size_t, const io::FullScan&)> decide;
    /// Looks at each scan and its final labels; called from several threads. May be empty.
    std::function<void(std::size_t, const io::FullScan&, const Labels&)> look;
    /// Takes each scan in order, after its labels are written.
    std::function<void(std::size_t, const io::FullScan&, const Verdict&)> use;
};

/// What the watch sees of the scans that are written, in order.
struct WrittenScans {
    std::vector<io::ScanWatch> watch;
    std::vector<io::DynamicBeside> beside;
    std::vector<io::Alarm> breaks;  ///< scans that do not go on where those before them ended
};

/// Writes what a run leaves of these scans into `folder`: a label file for each, and with `maps`
/// static_map.pcd, dynamic_points.pcd and map_gaps.bin. Throws InputError if a scan cannot be read
/// any more.
WrittenScans write_scans(const io::Recording& recording, const std::vector<std::size_t>& scans,
                         const Config& config, bool maps, const std::filesystem::path& folder,
                         const ScanResults& results);

}  // namespace dynamic_filter::app
