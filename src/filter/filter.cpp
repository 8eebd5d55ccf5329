// SPDX-License-Identifier: MIT
#include "dynamic_filter/filter.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "filter/evidence_map.hpp"
#include "filter/label.hpp"
#include "filter/mirrors.hpp"
#include "filter/objects.hpp"
#include "geometry/beam_axis.hpp"
#include "geometry/map_frame.hpp"

namespace dynamic_filter {

namespace {

const Config& checked(const Config& config) {
    validate(config);
    if (config.method == Method::scans) return config;
    throw ConfigError(
        "DynamicFilter runs the preset default; OnlineFilter also runs paper and removert");
}

CellBounds bounds_of(const Region& region, double voxel_size) {
    const auto cell = [&](double metres) {
        return static_cast<int>(std::lround(metres / voxel_size));
    };
    const Eigen::AlignedBox2d& area = region.bounds;
    return {.low = {cell(area.min().x()), cell(area.min().y())},
            .high = {cell(area.max().x()), cell(area.max().y())}};
}

}  // namespace

struct DynamicFilter::Impl {
    /// Each of several sensors sees objects at times of its own.
    struct Sensor {
        Eigen::Index axis;  // see beam_axis(), of its first scan
        Objects objects;
    };

    Impl(const Config& settings, const std::optional<CellBounds>& bounds)
        : config(checked(settings)),
          frame{.voxel_size = config.map.voxel_size},
          map(config, bounds),
          instant(config) {}

    Scan place(Scan scan);
    void archive(Archive& archive);

    Verdict judge(const Scan& scan);
    [[nodiscard]] LocatedScan locate(const Scan& scan) const {
        const bool is_known = scan.sensor < sensors.size() && sensors[scan.sensor];
        const Eigen::Index axis = is_known ? sensors[scan.sensor]->axis : 2;
        return axis == 2 ? frame.locate(scan, map.grid().voxels())
                         : frame.locate(turned_to_z(scan, axis), map.grid().voxels());
    }
    /// What is known of the sensor; a new one is added with its first scan.
    Sensor& sensor_of(const Scan& scan);
    [[nodiscard]] std::vector<bool> what_stays(std::size_t index, const PointVoxels& voxels) const;
    [[nodiscard]] std::vector<StaticVoxel> in_world(std::span<const VoxelOccupancy> voxels) const;
    void judge_mirrors();
    /// Poses that disagree lift points above the ground by as much.
    [[nodiscard]] ScansConfig::Contact contact() const {
        ScansConfig::Contact contact = config.scans.contact;
        contact.height = std::max(contact.height, static_cast<double>(map.disagreement()));
        return contact;
    }

    Config config;
    MapFrame frame;
    std::vector<std::optional<Sensor>> sensors;  // by Scan::sensor
    EvidenceMap map;
    InstantLabels instant;
    bool finished = false;
    std::vector<Mirror> mirrors;  // after finish()
    VoxelDecisions decided;       // after finish()
    /// Per voxel, only with `map.time` = latest: see occupied_since().
    std::vector<std::optional<std::uint32_t>> since;
    StageTimes times;
};

DynamicFilter::DynamicFilter(const Config& config)
    : impl_(std::make_unique<Impl>(config, std::nullopt)) {}
DynamicFilter::DynamicFilter(const Config& config, const Region& region)
    : impl_(std::make_unique<Impl>(config, bounds_of(region, config.map.voxel_size))) {
    impl_->frame.origin = region.origin;
}
DynamicFilter::DynamicFilter(DynamicFilter&&) noexcept = default;
DynamicFilter& DynamicFilter::operator=(DynamicFilter&&) noexcept = default;
DynamicFilter::~DynamicFilter() = default;

Verdict DynamicFilter::push(Scan scan) {
    Verdict verdict = judge(std::move(scan));
    catch_up();
    return verdict;
}

Verdict DynamicFilter::judge(Scan scan) { return impl_->judge(impl_->place(std::move(scan))); }

/// The points go into voxels; if the scan is a keyframe, it observes the voxels around its points;
/// earlier keyframes observe the new voxels. Then each voxel of the scan gets a label from its own
/// evidence and that of its neighbors, and objects that are followed get theirs as a whole, down to
/// the ground.
Verdict DynamicFilter::Impl::judge(const Scan& scan) {
    return timed(times, "judge", [&] {
        const PointVoxels voxels = map.insert(scan, times);
        Objects& objects = sensors[scan.sensor]->objects;
        Verdict verdict;
        std::optional<Clusters> clusters;
        timed(times, "instant_verdict", [&] {  // clusters need no labels
            parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
                if (begin == 0) verdict = instant.label(scan.index, voxels, map.grid());
                if (end == 2) clusters = objects.clusters_in(scan, voxels);
            });
        });
        timed(times, "instances", [&] {
            if (clusters) objects.update(scan, voxels, *clusters, map, verdict.labels);
        });
        timed(times, "contact",
              [&] { instant.find_contacts(scan, voxels, map.grid(), contact(), verdict.labels); });
        return verdict;
    });
}

/// The newest keyframe observes the rest of the map, where its scan has no points.
void DynamicFilter::catch_up() {
    timed(impl_->times, "integrate", [&] { impl_->map.observe_elsewhere(impl_->times); });
}

/// The scan in the frame of the map, which begins with the first scan, and with its beams around z.
Scan DynamicFilter::Impl::place(Scan scan) {
    const std::string name = "scan " + std::to_string(scan.index);
    if (finished) throw Error(name + " comes after finish(): make another filter");
    if (!scan.has_pose) {
        throw Error(name + " has no pose; OnlineFilter finds the poses of such scans");
    }
    const Eigen::Index axis = sensor_of(scan).axis;
    frame.begin(scan.T_world_sensor);
    scan.T_world_sensor = frame.to_map(scan.T_world_sensor);
    return turned_to_z(std::move(scan), axis);
}

DynamicFilter::Impl::Sensor& DynamicFilter::Impl::sensor_of(const Scan& scan) {
    if (scan.sensor >= sensors.size()) sensors.resize(scan.sensor + 1);
    auto& sensor = sensors[scan.sensor];
    if (!sensor) sensor = Sensor{beam_axis(scan.points), Objects(config.scans.instances)};
    return *sensor;
}

void DynamicFilter::begin_drive() {
    impl_->map.begin_drive();
    for (auto& sensor : impl_->sensors) {
        if (sensor) sensor->objects = Objects(impl_->config.scans.instances);
    }
}

void DynamicFilter::look_again(std::size_t drive, Scan scan) {
    if (!impl_->frame.origin) return;
    scan.T_world_sensor = impl_->frame.to_map(scan.T_world_sensor);
    const Eigen::Index axis = impl_->sensor_of(scan).axis;
    scan = turned_to_z(std::move(scan), axis);
    timed(impl_->times, "look_again", [&] { impl_->map.look_again(drive, scan); });
}

std::vector<bool> DynamicFilter::are_to_look_again(std::span<const Scan> scans) const {
    if (!impl_->frame.origin) return std::vector<bool>(scans.size(), false);
    std::vector<Scan> in_map(scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
        in_map[i] = {{}, impl_->frame.to_map(scans[i].T_world_sensor), scans[i].stamp, i};
        in_map[i].sensor = scans[i].sensor;
    }
    return impl_->map.are_to_look_again(in_map);
}

/// In the order of the members.
void DynamicFilter::Impl::archive(Archive& archive) {
    Eigen::Vector3d origin = frame.origin.value_or(Eigen::Vector3d::Zero());
    bool has_origin = frame.origin.has_value();
    archive.value(has_origin);
    archive.value(origin);
    if (has_origin) frame.origin = origin;
    std::vector<Eigen::Index> axes;  // -1: no scan of the sensor
    for (const auto& sensor : sensors) axes.push_back(sensor ? sensor->axis : -1);
    archive.values(axes);
    map.archive(archive);
    instant.archive(archive);
    if (!archive.reads()) return;
    sensors.resize(axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (axes[i] >= 0) sensors[i] = Sensor{axes[i], Objects(config.scans.instances)};
    }
}

std::vector<std::byte> DynamicFilter::evidence() const {
    Archive archive;
    impl_->archive(archive);
    return archive.take();
}

void DynamicFilter::go_on_from(std::span<const std::byte> evidence) {
    if (size() > 0 || impl_->finished) throw Error("a filter goes on before its first scan");
    Archive archive(evidence);
    impl_->archive(archive);
    if (!archive.is_at_end()) throw Error("there are more bytes than those of the evidence");
}

void DynamicFilter::finish() {
    if (std::exchange(impl_->finished, true)) return;
    Config& config = impl_->config;
    config.scans.contact = impl_->contact();
    timed(impl_->times, "mirrors", [&] {
        impl_->mirrors = find_mirrors(impl_->map, config.scans.mirrors);
        if (!impl_->mirrors.empty()) observe_behind(impl_->mirrors, impl_->map);
    });
    timed(impl_->times, "finish", [&] {
        impl_->decided = decide_voxels(impl_->map.grid(), config);
        impl_->judge_mirrors();
        if (config.map.time == MapTime::latest) {
            impl_->since = occupied_since(impl_->decided, impl_->map.grid(), config);
        }
    });
}

Verdict DynamicFilter::verdict(const Scan& scan) const {
    std::vector<std::uint32_t> voxels;
    return verdict(scan, voxels);
}

Verdict DynamicFilter::verdict(const Scan& scan, std::vector<std::uint32_t>& voxels) const {
    Verdict verdict = unknown_verdict(scan);
    if (!impl_->finished) {
        voxels.assign(scan.points.size(), kNoVoxel);
        return verdict;
    }
    LocatedScan located = impl_->locate(scan);
    decide_points(located, impl_->decided, impl_->map.grid(), impl_->config, verdict);
    verdict.stays = impl_->what_stays(scan.index, located.voxels);
    voxels = std::move(located.voxels);
    return verdict;
}

/// A voxel that was hardly seen but in a mirror is no part of the static map; the mirror itself is.
void DynamicFilter::Impl::judge_mirrors() {
    if (mirrors.empty()) return;
    const EvidenceGrid& grid = map.grid();
    const auto decide = [&](std::uint32_t v, Label label, float probability) {
        decided.voxels[v] = {.label = label, .has_contact = false};
        decided.probability[v] = probability;
    };
    for (std::uint32_t v = 0; v < decided.voxels.size(); ++v) {
        const auto& [centroid, score, e] = grid[v];
        const auto is_seen_in = [&, at = centroid](std::uint32_t owner) {
            return is_reflected(mirrors, map.sensor_of_owner(owner), at);
        };
        constexpr unsigned kFewOf = 4;  // of its scans, keyframes that saw it directly
        if (is_seen_in(e.first_owner) && (is_seen_in(e.last_owner) || kFewOf * e.n_occ < e.n_own)) {
            decide(v, Label::dynamic, 0.0F);
        } else if (is_on(mirrors, centroid)) {
            decide(v, Label::static_, 1.0F);
        }
    }
}

/// See Verdict::stays.
std::vector<bool> DynamicFilter::Impl::what_stays(std::size_t index,
                                                  const PointVoxels& voxels) const {
    if (config.map.time != MapTime::latest) return {};
    std::vector<bool> stays(voxels.size());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] >= since.size() || !since[voxels[i]]) continue;  // also for kNoVoxel
        stays[i] = index >= map.index_of_owner(*since[voxels[i]]);
    }
    return stays;
}

Verdict DynamicFilter::settled(const Scan& scan) const {
    Verdict verdict = unknown_verdict(scan);
    settle_points(impl_->locate(scan), impl_->map.grid(), impl_->config, impl_->contact(), verdict);
    return verdict;
}

std::vector<std::uint32_t> DynamicFilter::voxels_of(const Scan& scan) const {
    return impl_->locate(scan).voxels;
}

std::vector<VoxelHistory> DynamicFilter::histories(std::span<const std::uint32_t> voxels) const {
    const EvidenceMap& map = impl_->map;
    std::vector<VoxelHistory> histories(voxels.size());
    std::vector<std::uint32_t> seen_through;
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const Evidence& e = map.grid()[voxels[i]].evidence;
        histories[i] = {.probability = impl_->decided.occupancy(voxels[i]),
                        .n_own = e.n_own,
                        .n_occ = e.n_occ,
                        .n_free = e.n_free,
                        .n_switch = e.n_switch,
                        .free = static_cast<float>(e.free) / kSure,
                        .expected_free = map.grid().expected_free(e),
                        .score = map.grid()[voxels[i]].score,
                        .first = map.index_of_owner(e.first_owner),
                        .last = map.index_of_owner(e.last_owner),
                        .free_keyframes = {}};
        // Not for voxels that stay in the map: they would need many keyframes and tell little.
        if (e.n_free == 0 || impl_->decided.voxels[voxels[i]].label != Label::dynamic) continue;
        seen_through.push_back(voxels[i]);
        at.push_back(i);
    }
    auto keyframes = map.free_keyframes(seen_through);
    for (std::size_t i = 0; i < at.size(); ++i) {
        histories[at[i]].free_keyframes = std::move(keyframes[i]);
    }
    return histories;
}

void DynamicFilter::keep_within(const Pose& T_world_center, double radius, std::size_t most) {
    if (!impl_->frame.origin) return;
    const Eigen::Vector3d center = impl_->frame.to_map(T_world_center).translation();
    const std::vector<std::uint32_t> kept =
        impl_->map.keep_within(center.cast<float>(), static_cast<float>(radius), most);
    impl_->instant.keep(kept);
    for (auto& sensor : impl_->sensors) {
        if (sensor) sensor->objects.keep(kept);
    }
}

std::size_t DynamicFilter::size() const { return impl_->map.grid().size(); }

std::vector<StaticVoxel> DynamicFilter::Impl::in_world(
    std::span<const VoxelOccupancy> voxels) const {
    std::vector<StaticVoxel> result;
    result.reserve(voxels.size());
    for (const auto& [voxel, probability] : voxels) {
        const VoxelKey key = map.grid().voxels().key(voxel);
        result.push_back({frame.center_of(key), probability, voxel});
    }
    return result;
}

std::vector<StaticVoxel> DynamicFilter::local_static_map(const Pose& T_world_query,
                                                         std::optional<double> radius) const {
    if (!impl_->frame.origin) return {};
    const Eigen::Vector3d center = impl_->frame.to_map(T_world_query).translation();
    const double reach = radius.value_or(impl_->config.map.search_radius);
    const EvidenceGrid& grid = impl_->map.grid();
    const auto near = grid.within(center.cast<float>(), static_cast<float>(reach));
    return impl_->in_world(static_among(near, grid, impl_->config));
}

std::vector<StaticVoxel> DynamicFilter::static_map() const {
    std::vector<VoxelOccupancy> voxels;
    for (std::uint32_t v = 0; v < impl_->decided.voxels.size(); ++v) {
        if (impl_->decided.voxels[v].label == Label::static_) {
            voxels.push_back({v, impl_->decided.probability[v]});
        } else if (v < impl_->since.size() && impl_->since[v]) {
            voxels.push_back({v, 1.0F});  // seen there until the end of the recording
        }
    }
    return impl_->in_world(voxels);
}

StageTimes DynamicFilter::times() const { return impl_->times; }

MapContents DynamicFilter::contents() const {
    const Keyframes& keyframes = impl_->map.keyframes();
    MapContents contents;
    contents.observer = "keyframes";
    contents.observers = keyframes.total();
    contents.voxels = impl_->map.grid().voxels().size();
    contents.beams = keyframes.beams();
    for (const Keyframe& keyframe : keyframes.kept()) contents.keyframes.push_back(keyframe.index);
    const std::size_t scans = impl_->map.grid().scans();
    contents.throughput = {{"judge", "scans", scans}, {"integrate", "scans", scans}};
    return contents;
}

}  // namespace dynamic_filter
