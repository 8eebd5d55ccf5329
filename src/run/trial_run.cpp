// SPDX-License-Identifier: MIT
#include "run/trial_run.hpp"

#include <algorithm>
#include <utility>

#include "check/pieces.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::app {
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

std::vector<io::ScanWatch> watch_piece(const io::Piece& piece, const Config& config) {
    DynamicFilter filter(config);
    std::vector<Scan> scans;
    for (const Scan& scan : piece) {
        scans.push_back(thinned_scan_of(scan));
        filter.push(scans.back());
    }
    filter.finish();
    std::vector<io::ScanWatch> watch;
    for (const Scan& scan : scans) {
        watch.push_back(io::watch_scan(scan.index, scan.points, scan.T_world_sensor,
                                       filter.verdict(scan).labels));
    }
    return watch;
}

}  // namespace

std::vector<io::Alarm> try_run(const io::Recording& recording, const Config& config) {
    constexpr std::size_t kTrialPlaces = 3, kTrialScans = 40;
    std::vector<io::ScanWatch> watch;
    for (const io::Piece& piece : io::read_pieces(recording, kTrialPlaces, kTrialScans)) {
        const std::vector<io::ScanWatch> more = watch_piece(piece, config);
        watch.insert(watch.end(), more.begin(), more.end());
    }
    std::sort(watch.begin(), watch.end(),
              [](const io::ScanWatch& a, const io::ScanWatch& b) { return a.scan < b.scan; });
    std::vector<io::Alarm> alarms = io::alarms_of(watch);
    for (io::Alarm& alarm : alarms) {
        alarm = io::explain(std::move(alarm), recording, io::PosesFrom::given, config.odometry);
    }
    return alarms;
}

}  // namespace dynamic_filter::app
