// SPDX-License-Identifier: MIT
#include "dynamic_filter/online.hpp"

#include <utility>

#include "dynamic_filter/error.hpp"
#include "online/maps.hpp"
#include "online/scan_worker.hpp"
#include "settings/table.hpp"

namespace dynamic_filter {

namespace {

OnlineOptions checked(OnlineOptions options) {
    for (const std::string& fault : violations(options)) {
        throw ConfigError("OnlineOptions: " + fault);
    }
    return options;
}

}  // namespace

std::vector<std::string> violations(const OnlineOptions& options) {
    std::vector<std::string> found;
    for (const settings::Row& row : settings::rows_of(options)) {
        if (auto fault = settings::out_of_bounds(row)) found.push_back(std::move(*fault));
    }
    return found;
}

struct OnlineFilter::Engine {
    Engine(const Config& config, const OnlineOptions& options, OnlineCallbacks callbacks)
        : maps(config, checked(options)), worker(maps, options, std::move(callbacks)) {}

    Maps maps;
    ScanWorker worker;  // the last: its thread uses the maps
};

OnlineFilter::OnlineFilter(const Config& config, OnlineOptions options, OnlineCallbacks callbacks)
    : engine_(std::make_unique<Engine>(config, options, std::move(callbacks))) {}

OnlineFilter::~OnlineFilter() = default;

void OnlineFilter::push(Scan scan) { engine_->worker.push(std::move(scan)); }
std::optional<Verdict> OnlineFilter::ask(Scan scan) { return engine_->worker.ask(std::move(scan)); }
void OnlineFilter::begin_anew() { engine_->worker.begin_anew(); }
void OnlineFilter::flush() { engine_->worker.flush(); }
void OnlineFilter::finish() { engine_->worker.finish(); }
Counters OnlineFilter::counters() const { return engine_->worker.counters(); }

Verdict OnlineFilter::settled(const Scan& scan) const {
    Verdict verdict;
    engine_->worker.with_maps([&](const Maps& maps) { verdict = maps.settled(scan); });
    return verdict;
}

std::vector<StaticVoxel> OnlineFilter::local_static_map(const Pose& T_world_query,
                                                        std::optional<double> radius) {
    std::vector<StaticVoxel> voxels;
    engine_->worker.with_maps(
        [&](Maps& maps) { voxels = maps.local_static_map(T_world_query, radius); });
    return voxels;
}

StageTimes OnlineFilter::times() const {
    StageTimes times = engine_->maps.times();
    times["latency"] = engine_->worker.latency();
    return times;
}

bool OnlineFilter::judges_each_scan() const { return engine_->maps.judges_each_scan(); }
Verdict OnlineFilter::verdict(const Scan& scan) const { return engine_->maps.verdict(scan); }
std::vector<std::uint64_t> OnlineFilter::places_of(const Scan& scan) const {
    return engine_->maps.places_of(scan);
}
std::vector<VoxelHistory> OnlineFilter::histories(std::span<const std::uint64_t> places) const {
    return engine_->maps.histories(places);
}
std::vector<StaticVoxel> OnlineFilter::static_map() const { return engine_->maps.static_map(); }
std::size_t OnlineFilter::maps() const { return engine_->maps.size(); }
MapContents OnlineFilter::contents() const { return engine_->maps.contents(); }

}  // namespace dynamic_filter
