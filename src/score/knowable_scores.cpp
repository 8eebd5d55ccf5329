// SPDX-License-Identifier: MIT
#include "score/knowable_scores.hpp"

#include <algorithm>
#include <limits>

#include "geometry/voxel_index.hpp"
#include "score/for_each_scan.hpp"

namespace dynamic_filter::eval {

namespace {

template <std::uint16_t least>
bool is_passed(const KnowablePoint& p) {
    return p.beams >= least;
}

template <ThingState state>
bool is_in_state(const KnowablePoint& p) {
    return p.state == state;
}

bool is_knowable(const KnowablePoint& p) { return is_passed<3>(p) || p.is_seen_moving; }

std::optional<double> removed_share(std::size_t removed, std::size_t all) {
    if (all == 0) return std::nullopt;
    return static_cast<double>(removed) / static_cast<double>(all);
}

std::size_t bin_of(std::uint16_t beams) {
    const auto* const above = std::upper_bound(kBeamBins.begin(), kBeamBins.end(), beams);
    return static_cast<std::size_t>(above - kBeamBins.begin()) - 1;
}

/// A voxel of the raw map.
struct SeenVoxel {
    /// As of a voxel without points: any point tells less.
    KnowablePoint least{.beams = std::numeric_limits<std::uint16_t>::max(),
                        .state = ThingState::still,
                        .is_seen_moving = true};
    bool is_still = false, is_dynamic = false;  // both: mixed
    bool is_kept = false;

    void add(const KnowablePoint& p) {
        is_dynamic = true;
        least = {std::min(least.beams, p.beams), std::max(least.state, p.state),
                 least.is_seen_moving && p.is_seen_moving};
    }
};

class KnowableTally {
public:
    explicit KnowableTally(double voxel_size)
        : voxels_per_metre_(static_cast<float>(1.0 / voxel_size)) {
        scores_.groups.resize(knowable_groups().size());
    }

    void add(const LabelledScan& scan, const std::vector<KnowablePoint>& knowable) {
        const KeyedPoints keyed = keys_of(scan.points, voxels_per_metre_);
        std::vector<std::uint32_t> ids(keyed.keys.size());
        index_.insert(keyed.keys, ids);
        voxels_.resize(index_.size());
        for (std::size_t k = 0; k < ids.size(); ++k) {
            const std::size_t i = keyed.points[k];
            if (scan.truth[i] != Label::unknown) {
                add(voxels_[ids[k]], scan.truth[i], scan.verdict[i], knowable[i]);
            }
        }
    }

    KnowableScores scores() {
        for (const SeenVoxel& voxel : voxels_) {
            if (!voxel.is_dynamic || voxel.is_still) continue;
            each_of(voxel.least, [&](Removed& removed) {
                ++removed.voxels;
                removed.removed_voxels += voxel.is_kept ? 0U : 1U;
            });
        }
        return scores_;
    }

private:
    void add(SeenVoxel& voxel, Label truth, Label verdict, const KnowablePoint& knowable) {
        const bool is_removed = verdict == Label::dynamic;
        voxel.is_kept = voxel.is_kept || !is_removed;
        if (truth != Label::dynamic) {
            voxel.is_still = true;
            return;
        }
        voxel.add(knowable);
        each_of(knowable, [&](Removed& removed) {
            ++removed.points;
            removed.removed_points += is_removed ? 1U : 0U;
        });
    }
    /// Calls use() with the sums of each group, and of the bin, to which that belongs.
    template <class Use>
    void each_of(const KnowablePoint& what, const Use& use) {
        static const std::vector<KnowableGroup> groups = knowable_groups();
        for (std::size_t g = 0; g < groups.size(); ++g) {
            if (groups[g].holds(what)) use(scores_.groups[g]);
        }
        use(scores_.bins[bin_of(what.beams)]);
    }

    float voxels_per_metre_;
    VoxelIndex index_;
    std::vector<SeenVoxel> voxels_;
    KnowableScores scores_;
};

}  // namespace

std::optional<double> Removed::point_share() const { return removed_share(removed_points, points); }

std::optional<double> Removed::rr() const { return removed_share(removed_voxels, voxels); }

std::vector<KnowableGroup> knowable_groups() {
    return {{"all", "all", is_passed<0>},
            {"beams_1", "passed by 1 beam or more", is_passed<1>},
            {"beams_3", "passed by 3 or more", is_passed<3>},
            {"beams_10", "passed by 10 or more", is_passed<10>},
            {"moves", "moves", is_in_state<ThingState::moves>},
            {"moved", "rests, was seen to move", is_in_state<ThingState::moved>},
            {"will_move", "rests, will be seen to move", is_in_state<ThingState::will_move>},
            {"never", "rests, is never seen to move", is_in_state<ThingState::never>},
            {"knowable", "knowable", is_knowable}};
}

KnowableScores score_knowable(std::size_t scans, const ScanSource& source,
                              const KnowableSource& knowable, double voxel_size) {
    KnowableTally tally(voxel_size);
    for_each_scan(scans, source, [&](std::size_t i, const LabelledScan& scan) {
        tally.add(scan, knowable(i, scan.points.size()));
    });
    return tally.scores();
}

}  // namespace dynamic_filter::eval
