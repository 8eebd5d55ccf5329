// SPDX-License-Identifier: MIT
#include "check/trial_run.hpp"

#include <algorithm>
#include <utility>

#include "check/pieces.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::io {
namespace {

/// About every n-th point, so that the sensor's rings stay whole.
Scan thinned_scan_of(Scan scan) {
    constexpr std::size_t kMostPoints = 30000;
    const std::size_t stride = 1 + scan.points.size() / kMostPoints;
    Points points;
    for (std::size_t i = 0; i < scan.points.size(); i += stride) points.push_back(scan.points[i]);
    scan.points = std::move(points);
    scan.times.clear();
    return scan;
}

std::vector<ScanWatch> watch_piece(const Piece& piece, const Config& config) {
    DynamicFilter filter(config);
    std::vector<Scan> scans;
    for (const Scan& scan : piece) {
        scans.push_back(thinned_scan_of(scan));
        filter.push(scans.back());
    }
    filter.finish();
    std::vector<ScanWatch> watch;
    for (const Scan& scan : scans) {
        watch.push_back(
            watch_scan(scan.index, scan.points, scan.T_world_sensor, filter.verdict(scan).labels));
    }
    return watch;
}

}  // namespace

std::vector<Alarm> try_run(const Recording& recording, const Config& config) {
    constexpr std::size_t kTrialPlaces = 3, kTrialScans = 40;
    std::vector<ScanWatch> watch;
    for (const Piece& piece : read_pieces(recording, kTrialPlaces, kTrialScans)) {
        const std::vector<ScanWatch> more = watch_piece(piece, config);
        watch.insert(watch.end(), more.begin(), more.end());
    }
    std::sort(watch.begin(), watch.end(),
              [](const ScanWatch& a, const ScanWatch& b) { return a.scan < b.scan; });
    std::vector<Alarm> alarms = alarms_of(watch);
    for (Alarm& alarm : alarms) {
        alarm = explain(std::move(alarm), recording, PosesFrom::given, config.odometry);
    }
    return alarms;
}

}  // namespace dynamic_filter::io
