// SPDX-License-Identifier: MIT
#include "dynamic_filter/pipeline/dynamic_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "dynamic_filter/back_end/back_end.hpp"
#include "dynamic_filter/back_end/contact.hpp"
#include "dynamic_filter/back_end/evidence_map.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/front_end/front_end.hpp"
#include "dynamic_filter/geometry/map_points.hpp"
#include "dynamic_filter/geometry/pose.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/pipeline/merge.hpp"

namespace dynamic_filter {

namespace {

Config checked(const Config& config) {
    validate(config);
    Config result = config;
    if (config.method == Method::removert) {  // one window over the whole sequence, and no back-end
        result.submap.keyframes = std::numeric_limits<int>::max();
        result.front_end.enabled = true;
        result.back_end.enabled = false;
    }
    return result;
}

}  // namespace

struct BackEndWork {
    Submap submap;
    BeamPattern beams;  ///< that it was seen with
};

/// What DynamicFilter says of its functions holds for those of the same name.
struct DynamicFilter::Impl {
    explicit Impl(const Config& config);

    Judged judge(Scan scan);
    void integrate(const std::shared_ptr<BackEndWork>& work);
    std::vector<Verdict> finish();
    void keep_within(const Pose& T_world_center, double radius, std::size_t most);
    std::vector<StaticVoxel> local_static_map(const Pose& T_world_query,
                                              std::optional<double> radius);
    [[nodiscard]] std::vector<StaticVoxel> static_map() const;

    [[nodiscard]] Verdict verdict(const Scan& scan) const;
    [[nodiscard]] Verdict settled(const Scan& scan) const;
    [[nodiscard]] std::vector<VoxelHistory> histories(std::span<const std::uint32_t> voxels) const;
    [[nodiscard]] bool scans_observe() const;
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] std::size_t submaps() const;
    [[nodiscard]] const VoxelIndex& voxels() const {
        return scans_observe() ? evidence_.voxels() : back_end_.voxels();
    }
    [[nodiscard]] const std::optional<BeamPattern>& beams() const {
        return scans_observe() ? evidence_.beams() : front_end_.beams();
    }
    [[nodiscard]] StageTimes times() const;

    Pose to_map_frame(const Pose& T_world_sensor) const;
    [[nodiscard]] StaticVoxel static_voxel(std::uint32_t voxel, float probability) const;
    [[nodiscard]] Judged process(const Window& window);
    [[nodiscard]] Verdict instant_verdict(std::size_t index, const PointVoxels& voxels);
    void decide_voxels();
    [[nodiscard]] std::optional<Surface> contact_of(std::uint32_t voxel) const;
    struct Located {
        MapPoints in_map;
        PointVoxels voxels;
        Verdict verdict;  // all unknown
    };
    [[nodiscard]] Located locate(const Scan& scan) const;
    [[nodiscard]] std::pair<Label, float> decision_on(std::uint32_t voxel, const Point& at) const;
    void judge_contacts(const Points& map_points, const PointVoxels& voxels, Labels& labels) const;
    void merge_local_maps();
    [[nodiscard]] Label label_of(std::optional<float> probability) const;

    Config config_;
    std::optional<Eigen::Vector3d> origin_;  // of the map frame, in the world
    WindowCutter cutter_;
    FrontEnd front_end_;
    BackEnd back_end_;
    EvidenceMap evidence_;
    struct Instant {
        float opinion = 2.0F;  // when it was asked last; none is as large
        Label label = Label::unknown;
    };
    std::vector<Instant> instant_;  // by voxel, when scans observe
    struct Decision {
        std::optional<float> probability;
        std::optional<Surface> contact;
    };
    std::vector<Decision> decided_;  // by voxel, when scans observe
    MergedMap merged_;
    bool finished_ = false;
    struct Kept {
        Point center;
        float radius;  // [m]
    };
    std::optional<Kept> kept_;             // of the submaps, once some are forgotten
    StageTimes front_times_, back_times_;  // of judge() and of the rest
};

DynamicFilter::Impl::Impl(const Config& config)
    : config_(checked(config)),
      cutter_(config_.submap),
      front_end_(config_),
      back_end_(config_),
      evidence_(config_) {}

bool DynamicFilter::Impl::scans_observe() const { return dynamic_filter::scans_observe(config_); }

Pose DynamicFilter::Impl::to_map_frame(const Pose& T_world_sensor) const {
    Pose shifted = T_world_sensor;
    shifted.translation() -= *origin_;
    return shifted;
}

std::size_t DynamicFilter::Impl::size() const {
    return scans_observe() ? evidence_.voxels().size() : back_end_.points();
}

std::size_t DynamicFilter::Impl::submaps() const {
    const auto keyframes = static_cast<std::size_t>(config_.submap.keyframes);
    return scans_observe() ? (evidence_.observers() + keyframes - 1) / keyframes
                           : back_end_.buffer().size();
}

Judged DynamicFilter::Impl::judge(Scan scan) {
    if (finished_) throw Error("push() after finish(): make another filter");
    if (!origin_) origin_ = nearby_origin(scan.T_world_sensor, config_.back_end.voxel_size);
    scan.T_world_sensor = to_map_frame(scan.T_world_sensor);
    if (!scans_observe()) {
        const auto window = cutter_.push(std::move(scan));
        return window ? process(*window) : Judged{};
    }
    Judged judged;
    timed(front_times_, "front_end", [&] {
        const PointVoxels voxels = evidence_.insert(scan, front_times_);
        judged.verdicts.push_back(timed(front_times_, "instant_verdict",
                                        [&] { return instant_verdict(scan.index, voxels); }));
    });
    return judged;
}

Judged DynamicFilter::Impl::process(const Window& window) {
    auto [submap, labels] =
        timed(front_times_, "front_end", [&] { return front_end_.process(window, front_times_); });
    Judged judged;
    judged.work =
        std::make_shared<BackEndWork>(BackEndWork{std::move(submap), *front_end_.beams()});
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        judged.verdicts.push_back({window.scans[s].index, std::move(labels[s]), {}});
    }
    return judged;
}

void DynamicFilter::Impl::integrate(const std::shared_ptr<BackEndWork>& work) {
    if (scans_observe()) {
        timed(back_times_, "back_end", [&] { evidence_.look_at_rest(back_times_); });
    } else if (work) {
        timed(back_times_, "back_end",
              [&] { back_end_.insert(std::move(work->submap), work->beams, back_times_); });
    }
}

std::vector<Verdict> DynamicFilter::Impl::finish() {
    if (std::exchange(finished_, true)) return {};
    if (scans_observe()) {
        timed(back_times_, "back_end",
              [&] { timed(back_times_, "merging", [&] { decide_voxels(); }); });
        return {};
    }
    std::vector<Verdict> instant;
    if (const auto window = cutter_.flush()) {
        Judged judged = process(*window);
        integrate(judged.work);
        instant = std::move(judged.verdicts);
    }
    if (config_.back_end.enabled) merge_local_maps();
    return instant;
}

StageTimes DynamicFilter::Impl::times() const {
    StageTimes all = front_times_;
    for (const auto& [stage, calls] : back_times_) all[stage].add(calls);
    return all;
}

void DynamicFilter::Impl::keep_within(const Pose& T_world_center, double radius, std::size_t most) {
    if (!origin_) return;
    const Pose T_map_center = to_map_frame(T_world_center);
    if (!scans_observe()) {
        const double reach = back_end_.keep_within(T_map_center.translation(), radius, most);
        kept_ = {T_map_center.translation().cast<float>(), static_cast<float>(reach)};
        return;
    }
    const auto kept = evidence_.keep_within(T_map_center.translation().cast<float>(),
                                            static_cast<float>(radius), most);
    std::vector<Instant> instant;
    instant.reserve(kept.size());
    for (const std::uint32_t v : kept) instant.push_back(instant_[v]);
    instant_ = std::move(instant);
}

void DynamicFilter::Impl::decide_voxels() {
    std::vector<std::uint32_t> all(evidence_.voxels().size());
    std::iota(all.begin(), all.end(), 0U);
    const auto probabilities = evidence_.probabilities(all);
    decided_.resize(all.size());
    for (std::size_t v = 0; v < all.size(); ++v) decided_[v].probability = probabilities[v];
    parallel_for(all.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) decided_[v].contact = contact_of(all[v]);
    });
}

std::optional<Surface> DynamicFilter::Impl::contact_of(std::uint32_t voxel) const {
    if (label_of(decided_[voxel].probability) != Label::still) return std::nullopt;
    bool touches_dynamic = false;
    evidence_.each_within(1, voxel, [&](std::uint32_t v, int) {
        touches_dynamic |= label_of(decided_[v].probability) == Label::dynamic;
    });
    if (!touches_dynamic) return std::nullopt;
    std::vector<VoxelVerdict> around;
    evidence_.each_within(2, voxel, [&](std::uint32_t v, int distance) {
        around.push_back({evidence_.centroid(v), label_of(decided_[v].probability), distance});
    });
    return contact_surface(around);
}

void DynamicFilter::Impl::merge_local_maps() {
    for (std::size_t i = 0; i < back_end_.buffer().size(); ++i) {
        timed(back_times_, "back_end", [&] {
            const LocalMap local = back_end_.local_map_of(i, back_times_);
            timed(back_times_, "merging", [&] {
                merge(merged_, local, back_end_.buffer()[i].submap.T_map_submap, back_end_.voxels(),
                      config_.back_end.voxel_size);
            });
        });
    }
}

Label DynamicFilter::Impl::label_of(std::optional<float> probability) const {
    if (!probability) return Label::unknown;
    const auto threshold = static_cast<float>(config_.back_end.occupancy_threshold);
    return *probability >= threshold ? Label::still : Label::dynamic;
}

/// From the evidence so far. A voxel is asked again when its own evidence says something else than
/// when it was asked last; most say what they said.
Verdict DynamicFilter::Impl::instant_verdict(std::size_t index, const PointVoxels& voxels) {
    constexpr float kSame = 0.2F;  // a tenth of the span of opinions
    instant_.resize(evidence_.voxels().size());
    std::vector<std::uint32_t> due;
    for (const std::uint32_t voxel : voxels) {
        if (voxel == kNoVoxel) continue;
        Instant& instant = instant_[voxel];
        const float opinion = evidence_.opinion(voxel);
        const bool same = std::abs(opinion - instant.opinion) <= kSame;
        if (same && instant.label != Label::unknown) continue;
        if (same && is_unknown(evidence_.evidence(voxel))) continue;
        instant = {opinion, Label::still};  // until it is judged, so that it is listed once
        due.push_back(voxel);
    }
    const auto probabilities = evidence_.probabilities(due);
    for (std::size_t i = 0; i < due.size(); ++i) {
        instant_[due[i]].label = label_of(probabilities[i]);
    }
    Verdict verdict{index, Labels(voxels.size(), Label::unknown), {}};
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] != kNoVoxel) verdict.labels[i] = instant_[voxels[i]].label;
    }
    return verdict;
}

std::vector<StaticVoxel> DynamicFilter::Impl::local_static_map(const Pose& T_world_query,
                                                               std::optional<double> radius) {
    std::vector<StaticVoxel> result;
    if (!origin_) return result;
    const Pose T_map_query = to_map_frame(T_world_query);
    if (scans_observe()) {
        const Point position = T_map_query.translation().cast<float>();
        const auto reach = static_cast<float>(radius.value_or(config_.back_end.search_radius));
        const std::vector<std::uint32_t> near = evidence_.within(position, reach);
        const auto probabilities = evidence_.probabilities(near);
        for (std::size_t i = 0; i < near.size(); ++i) {
            if (label_of(probabilities[i]) != Label::still) continue;
            result.push_back(static_voxel(near[i], *probabilities[i]));
        }
        return result;
    }
    const LocalMap local = back_end_.local_map(T_map_query, back_times_);
    for (std::size_t i = 0; i < local.voxels.size(); ++i) {
        if (label_of(std::optional(local.probability[i])) == Label::still) {
            result.push_back(static_voxel(local.voxels[i], local.probability[i]));
        }
    }
    return result;
}

std::vector<StaticVoxel> DynamicFilter::Impl::static_map() const {
    std::vector<StaticVoxel> result;
    for (std::uint32_t v = 0; v < voxels().size(); ++v) {
        const auto [label, probability] = decision_on(v, Point::Zero());
        if (label == Label::still) result.push_back(static_voxel(v, probability));
    }
    return result;
}

StaticVoxel DynamicFilter::Impl::static_voxel(std::uint32_t voxel, float probability) const {
    const auto size = static_cast<float>(config_.back_end.voxel_size);
    return {*origin_ + center(voxels().key(voxel), size).cast<double>(), probability};
}

DynamicFilter::Impl::Located DynamicFilter::Impl::locate(const Scan& scan) const {
    const std::size_t size = scan.points.size();
    Located located;
    located.verdict = {scan.index, Labels(size, Label::unknown), std::vector<float>(size, 0.0F)};
    located.voxels.assign(size, kNoVoxel);
    located.in_map.keys.assign(size, kNoKey);
    if (!origin_) return located;  // before the first scan
    to_voxels(scan.points, to_map_frame(scan.T_world_sensor),
              static_cast<float>(config_.back_end.voxel_size), located.in_map);
    VoxelFinder find(voxels());
    for (std::size_t i = 0; i < size; ++i) {
        if (located.in_map.keys[i] != kNoKey) located.voxels[i] = find(located.in_map.keys[i]);
    }
    return located;
}

Verdict DynamicFilter::Impl::verdict(const Scan& scan) const {
    auto [in_map, voxels, verdict] = locate(scan);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (in_map.keys[i] == kNoKey) continue;
        const auto [label, probability] = decision_on(voxels[i], in_map.points[i]);
        verdict.labels[i] = label;
        verdict.probability[i] = probability;
    }
    if (scans_observe()) judge_contacts(in_map.points, voxels, verdict.labels);
    return std::move(verdict);
}

/// Once finish() has decided; before it, all is unknown.
std::pair<Label, float> DynamicFilter::Impl::decision_on(std::uint32_t voxel,
                                                         const Point& at) const {
    constexpr std::pair kUnknown{Label::unknown, 0.0F};
    if (scans_observe()) {
        if (voxel >= decided_.size()) return kUnknown;
        const auto& probability = decided_[voxel].probability;
        return {label_of(probability), probability.value_or(0.0F)};
    }
    if (voxel == kNoVoxel) {  // no static submap holds it: forgotten, or removed by the front-end
        const bool forgotten = kept_ && (at - kept_->center).norm() > kept_->radius;
        return forgotten ? kUnknown : std::pair{Label::dynamic, 0.0F};
    }
    if (!config_.back_end.enabled) return {Label::still, 1.0F};
    if (voxel >= merged_.probability.size()) return kUnknown;
    const float probability = merged_.probability[voxel];
    return {label_of(std::optional(probability)), probability};
}

std::vector<VoxelHistory> DynamicFilter::Impl::histories(
    std::span<const std::uint32_t> voxels) const {
    std::vector<VoxelHistory> histories(voxels.size());
    if (!scans_observe()) {
        for (std::size_t i = 0; i < voxels.size(); ++i) {
            if (voxels[i] >= merged_.probability.size()) continue;
            const float probability = merged_.probability[voxels[i]];
            if (probability >= 0.0F) histories[i].probability = probability;
        }
        return histories;
    }
    std::vector<std::uint32_t> passed;
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const Evidence& evidence = evidence_.evidence(voxels[i]);
        histories[i] = {decided_[voxels[i]].probability,
                        evidence,
                        evidence_.index_of_owner(evidence.first_owner),
                        evidence_.index_of_owner(evidence.last_owner),
                        {}};
        if (evidence.passed == 0) continue;
        passed.push_back(voxels[i]);
        at.push_back(i);
    }
    auto seen_through = evidence_.seen_through(passed);
    for (std::size_t i = 0; i < at.size(); ++i) {
        histories[at[i]].seen_through = std::move(seen_through[i]);
    }
    return histories;
}

Verdict DynamicFilter::Impl::settled(const Scan& scan) const {
    auto [in_map, voxels, verdict] = locate(scan);
    if (!scans_observe()) return std::move(verdict);
    PointVoxels own = voxels;
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (!own.empty() && own.back() == kNoVoxel) own.pop_back();
    const auto probabilities = evidence_.probabilities(own);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] == kNoVoxel) continue;
        const auto at = std::lower_bound(own.begin(), own.end(), voxels[i]) - own.begin();
        const auto& probability = probabilities[static_cast<std::size_t>(at)];
        verdict.labels[i] = label_of(probability);
        verdict.probability[i] = probability.value_or(0.0F);
    }
    return std::move(verdict);
}

/// A static point becomes dynamic if it lies above the static surface of its voxel while, in this
/// very scan, something dynamic touches the voxel.
void DynamicFilter::Impl::judge_contacts(const Points& map_points, const PointVoxels& voxels,
                                         Labels& labels) const {
    std::vector<bool> moving(decided_.size());  // dynamic voxels with a point in this scan
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == Label::dynamic) moving[voxels[i]] = true;
        if (labels[i] != Label::still) continue;
        const auto& contact = decided_[voxels[i]].contact;
        if (contact && contact->height(map_points[i]) > kContactHeight) above.push_back(i);
    }
    for (const std::size_t i : above) {
        bool touches = false;
        evidence_.each_within(1, voxels[i], [&](std::uint32_t v, int) { touches |= moving[v]; });
        if (touches) labels[i] = Label::dynamic;
    }
}

DynamicFilter::DynamicFilter(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
DynamicFilter::DynamicFilter(DynamicFilter&&) noexcept = default;
DynamicFilter& DynamicFilter::operator=(DynamicFilter&&) noexcept = default;
DynamicFilter::~DynamicFilter() = default;

std::vector<Verdict> DynamicFilter::push(Scan scan) {
    Judged judged = judge(std::move(scan));
    integrate(judged.work);
    return std::move(judged.verdicts);
}
Judged DynamicFilter::judge(Scan scan) { return impl_->judge(std::move(scan)); }
void DynamicFilter::integrate(const std::shared_ptr<BackEndWork>& work) { impl_->integrate(work); }
bool DynamicFilter::front_end_waits() const { return impl_->scans_observe(); }
std::vector<Verdict> DynamicFilter::finish() { return impl_->finish(); }

Verdict DynamicFilter::verdict(const Scan& scan) const { return impl_->verdict(scan); }
Verdict DynamicFilter::settled(const Scan& scan) const { return impl_->settled(scan); }
std::vector<std::uint32_t> DynamicFilter::voxels_of(const Scan& scan) const {
    return impl_->locate(scan).voxels;
}
std::vector<VoxelHistory> DynamicFilter::histories(std::span<const std::uint32_t> voxels) const {
    return impl_->histories(voxels);
}
std::vector<std::size_t> DynamicFilter::keyframes() const { return impl_->evidence_.keyframes(); }
std::size_t DynamicFilter::keyframes_total() const { return impl_->evidence_.observers(); }

void DynamicFilter::keep_within(const Pose& T_world_center, double radius, std::size_t most) {
    impl_->keep_within(T_world_center, radius, most);
}
std::size_t DynamicFilter::size() const { return impl_->size(); }
std::vector<StaticVoxel> DynamicFilter::local_static_map(const Pose& T_world_query,
                                                         std::optional<double> radius) {
    return impl_->local_static_map(T_world_query, radius);
}

std::vector<StaticVoxel> DynamicFilter::static_map() const { return impl_->static_map(); }

StageTimes DynamicFilter::times() const { return impl_->times(); }
std::optional<BeamPattern> DynamicFilter::beams() const { return impl_->beams(); }
std::size_t DynamicFilter::submaps() const { return impl_->submaps(); }
std::size_t DynamicFilter::voxels() const { return impl_->voxels().size(); }

}  // namespace dynamic_filter
