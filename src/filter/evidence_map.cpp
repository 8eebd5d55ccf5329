// SPDX-License-Identifier: MIT
#include "filter/evidence_map.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "dynamic_filter/parallel.hpp"
#include "filter/alignment.hpp"

namespace dynamic_filter {

namespace {

const Eigen::Isometry3f kNotMoved = Eigen::Isometry3f::Identity();
constexpr std::size_t kBlocksAtATime = 64;  // number of blocks that a thread takes at a time
/// The newest scan is aligned with every second keyframe first, and with the others only if it does
/// not fit one of these. After so many scans in a row that fitted all, every eighth is enough.
constexpr std::size_t kFitting = 8;
constexpr std::size_t kTestedFirst = 2, kTestedLater = 8;

/// Sure voxels are asked in turn, one of so many by each keyframe. In every plane of a block, the
/// voxels of a turn are as many as those of the others.
constexpr unsigned kTurns = 4;
constexpr std::array<std::uint64_t, kTurns> kInTurn = [] {
    std::array<std::uint64_t, kTurns> places{};
    for (unsigned place = 0; place < 64; ++place) {
        const unsigned x = place >> 4U, y = place >> 2U & 3U, z = place & 3U;
        places[(x + 2 * y + 3 * z) % kTurns] |= std::uint64_t{1} << place;
    }
    return places;
}();

Config with_one_keyframe(Config config) {
    config.scans.max_keyframes = 1;
    return config;
}

}  // namespace

EvidenceMap::EvidenceMap(const Config& config, const std::optional<CellBounds>& bounds)
    : margins_(margins_of(config.scans.sight, config.map.voxel_size)),
      alignment_gain_(static_cast<float>(config.scans.sight.alignment_gain)),
      grid_(static_cast<float>(config.map.voxel_size), config.scans.evidence, bounds),
      keyframes_(config),
      keyframe_(config.keyframe),
      again_{.drive = {}, .keyframes = Keyframes(with_one_keyframe(config)), .blocks = {}} {
    if (!bounds) return;
    area_.emplace(config.map.voxel_size * bounds->low.cast<double>(),
                  config.map.voxel_size * bounds->high.cast<double>());
}

/// False if no place within the bounds is in the reach of the scan.
bool EvidenceMap::may_observe(const Scan& scan) const {
    if (!area_) return true;
    const Eigen::Vector2d sensor = scan.T_world_sensor.translation().head<2>();
    return area_->exteriorDistance(sensor) <= static_cast<double>(margins_.farthest);
}

void EvidenceMap::begin_drive() {
    keyframes_.begin_drive();
    fitting_ = 0;
    known_after_.push_back(grid_.size());
}

void EvidenceMap::look_again(std::size_t drive, const Scan& scan) {
    const std::uint32_t known = known_after_.at(drive);
    if (again_.drive != drive) {
        again_.drive = drive;
        again_.keyframes.begin_drive();
        again_.blocks = grid_.blocks_from(known);
    }
    if (!may_observe(scan) || !again_.keyframes.add(scan)) return;
    observe(again_.keyframes, again_.blocks, false, [&](std::uint32_t v) { return v >= known; });
}

std::vector<bool> EvidenceMap::are_to_look_again(std::span<const Scan> scans) const {
    KeyframeChoice choice(keyframe_);
    std::vector<bool> are;
    for (const Scan& scan : scans) are.push_back(may_observe(scan) && choice.take(scan));
    return are;
}

void EvidenceMap::archive(Archive& archive) {
    grid_.archive(archive);
    keyframes_.archive(archive);
    archive.values(known_after_);
    archive.value(disagreement_);
    archive.values(indices_);
    archive.values(sensors_);
}

PointVoxels EvidenceMap::insert(const Scan& scan, StageTimes& times) {
    is_due_ = false;
    if (std::none_of(scan.points.begin(), scan.points.end(), is_measured)) {
        return PointVoxels(scan.points.size(), kNoVoxel);
    }
    known_ = grid_.size();
    const auto owner = static_cast<std::uint32_t>(indices_.size());
    PointVoxels voxels_of_points;
    timed(times, "insertion", [&] {  // insertion of the points beside that of the beams
        parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
            if (begin == 0) voxels_of_points = grid_.add_points(scan);
            if (end == 2) is_due_ = may_observe(scan) && keyframes_.add(scan, owner);
        });
    });
    indices_.push_back(scan.index);
    sensors_.push_back(scan.T_world_sensor.translation().cast<float>());
    timed(times, "alignment", [&] { align(scan); });
    timed(times, "visibility_check", [&] {
        if (is_due_) check_known(grid_.blocks_touched(true));
        check_new();
    });
    return voxels_of_points;
}

void EvidenceMap::observe_elsewhere(StageTimes& times) {
    if (!std::exchange(is_due_, false) || known_ == 0) return;
    timed(times, "visibility_check_elsewhere", [&] { check_known(grid_.blocks_touched(false)); });
}

/// Voxels that are to be observed, ordered by block.
struct EvidenceMap::Places {
    std::vector<std::uint32_t> blocks;
    // For each block, the index of its first voxel below; then the end.
    std::vector<std::size_t> first;
    std::vector<std::uint32_t> voxels;
    std::vector<std::uint64_t> in_block;  // for each voxel, the bit of its place in the block
    Points centroids;
};

/// Blocks, and a bit for each place in them that is meant; see VoxelIndex::each_in_block().
struct EvidenceMap::BlockParts {
    std::vector<std::uint32_t> blocks{};
    std::vector<std::uint64_t> parts{};

    void add(std::uint32_t block, std::uint64_t part) {
        blocks.push_back(block);
        parts.push_back(part);
    }
};

/// The voxels of these blocks for which `wanted` is true.
template <class Wanted>
EvidenceMap::Places EvidenceMap::places_in(std::vector<std::uint32_t> blocks,
                                           const Wanted& wanted) const {
    BlockParts whole{.blocks = std::move(blocks)};
    whole.parts.assign(whole.blocks.size(), ~std::uint64_t{0});
    return places_in(std::move(whole), wanted);
}

template <class Wanted>
EvidenceMap::Places EvidenceMap::places_in(BlockParts in, const Wanted& wanted) const {
    Places places{.blocks = std::move(in.blocks),
                  .first = {0},
                  .voxels = {},
                  .in_block = {},
                  .centroids = {}};
    for (std::size_t b = 0; b < places.blocks.size(); ++b) {
        constexpr std::size_t kAhead = 4;
        if (b + kAhead < places.blocks.size()) {
            grid_.voxels().prefetch_block(places.blocks[b + kAhead]);
        }
        grid_.voxels().each_in_block(places.blocks[b], in.parts[b], [&](std::uint32_t v, int at) {
            if (!wanted(v)) return;
            places.voxels.push_back(v);
            places.in_block.push_back(std::uint64_t{1} << static_cast<unsigned>(at));
        });
        places.first.push_back(places.voxels.size());
    }
    places.centroids.reserve(places.voxels.size());
    for (std::size_t i = 0; i < places.voxels.size(); ++i) {
        // Prefetched, because the voxels of a block may be far apart in memory.
        constexpr std::size_t kAhead = 16;
        if (i + kAhead < places.voxels.size()) {
            __builtin_prefetch(&grid_[places.voxels[i + kAhead]]);
        }
        places.centroids.push_back(grid_[places.voxels[i]].centroid);
    }
    return places;
}

/// The newest keyframe observes the voxels that were known before its scan.
void EvidenceMap::check_known(std::span<const std::uint32_t> blocks) {
    observe(keyframes_, blocks, true, [&](std::uint32_t v) { return v < known_; });
}

/// The newest of the keyframes observes the voxels of these blocks for which `wanted` is true. Of
/// the sure ones it asks those whose turn it is, and the others of a block only if one of these is
/// no longer what it was: then something has come or left.
template <class Wanted>
void EvidenceMap::observe(const Keyframes& keyframes, std::span<const std::uint32_t> blocks,
                          bool newest, const Wanted& wanted) {
    const Keyframe& keyframe = keyframes.kept().back();
    const std::uint64_t turn = kInTurn[keyframes.total() % kTurns];
    parallel_for(blocks.size(), kBlocksAtATime, [&](std::size_t begin, std::size_t end) {
        const auto some = blocks.subspan(begin, end - begin);
        const float slack = newest ? moved_by_ : 0.0F;
        BlockParts in_sight;
        for (const std::size_t b : blocks_in_sight(some, keyframe, kNotMoved, slack)) {
            in_sight.add(some[b], ~grid_.sure_in(some[b]) | turn);
        }
        const auto ask = [&](BlockParts parts) {
            Places places = places_in(std::move(parts), wanted);
            if (newest) move_to_newest(places);
            return record(places, look(keyframe, places.centroids), newest);
        };
        BlockParts left = ask(std::move(in_sight));
        for (std::uint64_t& part : left.parts) part &= ~turn;
        ask(std::move(left));
    });
}

/// Records what the places are seen as. Returns the blocks in which a sure voxel is no longer what
/// it was, and all voxels that were sure there.
EvidenceMap::BlockParts EvidenceMap::record(const Places& places, const std::vector<Sight>& sights,
                                            bool newest) {
    BlockParts changed;
    for (std::size_t b = 0; b < places.blocks.size(); ++b) {
        const std::uint64_t before = grid_.sure_in(places.blocks[b]);
        std::uint64_t sure = before;
        for (std::size_t i = places.first[b]; i < places.first[b + 1]; ++i) {
            if (sights[i] == Sight::unknown) continue;
            const std::uint32_t v = places.voxels[i];
            const bool was_free = grid_[v].evidence.last == Sight::free;
            const bool changes = is_free(sights[i]) != was_free;
            const bool stands_for_all = (before & places.in_block[i]) != 0 && !changes;
            if (grid_.record(v, sights[i], stands_for_all ? kTurns : 1, newest)) {
                grid_.update_score(v);
            }
            sure = grid_.is_sure(v) ? sure | places.in_block[i] : sure & ~places.in_block[i];
        }
        grid_.set_sure_in(places.blocks[b], sure);
        if ((before & ~sure) != 0) changed.add(places.blocks[b], before);
    }
    return changed;
}

/// The earlier keyframes, oldest first, observe the voxels that the newest scan has added. Each
/// keyframe handles all of these voxels at once, so that its image stays in the cache.
void EvidenceMap::check_new() {
    const Places places =
        places_in(grid_.blocks_from(known_), [&](std::uint32_t v) { return v >= known_; });
    const std::vector<Keyframes::Asked> asked = keyframes_.asked_by_new();
    std::vector<std::vector<Sight>> sights(asked.size());
    parallel_for(asked.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const auto& aligned = alignments_.empty() ? kNotMoved : alignments_[k].to_keyframe;
            sights[k] = look(*asked[k].keyframe, places, aligned);
        }
    });
    parallel_for(places.voxels.size(), kBlocksAtATime, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t k = 0; k < asked.size(); ++k) {
                if (sights[k][i] == Sight::unknown) continue;
                const bool newest = is_due_ && k + 1 == asked.size();
                grid_.record(places.voxels[i], sights[k][i], asked[k].weight, newest);
            }
            grid_.update_score(places.voxels[i]);
        }
    });
}

/// Aligns the newest scan with the earlier keyframes that it asks. One that shares too few surfaces
/// with the scan is taken to be off as the next later one is.
void EvidenceMap::align(const Scan& scan) {
    alignments_.clear();
    moved_by_ = 0.0F;
    if (alignment_gain_ >= 1.0F) return;
    const std::vector<Keyframes::Asked> asked = keyframes_.asked_by_new();
    const std::size_t earlier = asked.size() - (is_due_ ? 1 : 0);
    const Points sample = alignment_sample(scan);
    std::vector<std::optional<Eigen::Isometry3f>> found(earlier);
    const std::size_t apart = fitting_ < kFitting ? kTestedFirst : kTestedLater;
    const auto fit = [&](std::size_t k) {
        found[k] = alignment_to(*asked[k].keyframe, sample, alignment_gain_);
    };
    parallel_for((earlier + apart - 1) / apart, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) fit(apart * i);
    });
    const bool is_off = std::any_of(found.begin(), found.end(), [](const auto& motion) {
        return motion && motion->matrix() != kNotMoved.matrix();
    });
    fitting_ = is_off ? 0 : fitting_ + 1;
    if (!is_off) return;  // poses are mostly good for all keyframes or for none
    parallel_for(earlier, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            if (k % apart != 0) fit(k);
        }
    });
    for (const Keyframes::Asked& a : asked) {
        alignments_.push_back({a.keyframe->owner, kNotMoved, kNotMoved});
    }
    const Point sensor = scan.T_world_sensor.translation().cast<float>();
    float sum = 0.0F;
    for (std::size_t k = earlier; k-- > 0;) {
        const bool has_next = k + 1 < alignments_.size();
        const Eigen::Isometry3f motion = found[k]   ? *found[k]
                                         : has_next ? alignments_[k + 1].to_keyframe
                                                    : kNotMoved;
        alignments_[k].to_keyframe = motion;
        alignments_[k].to_newest = motion.inverse();
        const float moved = (motion * sensor - sensor).norm();
        const float turn = Eigen::AngleAxisf(motion.linear()).angle();
        moved_by_ = std::max(moved_by_, moved + turn * margins_.farthest);
        sum += moved;
    }
    disagreement_ += sum / static_cast<float>(earlier);
}

/// Moves the places of earlier scans to where the newest scan would see them, with the motion of
/// the next keyframe after the scan that found the place.
void EvidenceMap::move_to_newest(Places& places) const {
    if (alignments_.empty()) return;
    for (std::size_t i = 0; i < places.voxels.size(); ++i) {
        const std::uint32_t owner = grid_[places.voxels[i]].evidence.first_owner;
        const auto next =
            std::lower_bound(alignments_.begin(), alignments_.end(), owner,
                             [](const Alignment& a, std::uint32_t o) { return a.owner < o; });
        if (next == alignments_.end()) continue;
        places.centroids[i] = next->to_newest * places.centroids[i];
    }
}

SightMargins EvidenceMap::margins_for(const Keyframe& keyframe) const {
    SightMargins margins = margins_;
    margins.farthest = keyframe.reach;
    if (keyframe.thinned > 0.0F) margins.apart = keyframe.thinned + grid_.voxel_size();
    return margins;
}

/// Indices of those blocks that may hold a voxel in the view of the keyframe, if they are moved by
/// `aligned`, and then by up to `slack` [m].
std::vector<std::size_t> EvidenceMap::blocks_in_sight(std::span<const std::uint32_t> blocks,
                                                      const Keyframe& keyframe,
                                                      const Eigen::Isometry3f& aligned,
                                                      float slack) const {
    const SightMargins margins = margins_for(keyframe);
    // Radius of the sphere around a block, and a little more.
    const float radius = 3.5F * grid_.voxel_size() + slack;
    const Point sensor = keyframe.T_sensor_map.inverse().translation();
    // A little more, because may_see() decides.
    const float in_reach = margins.farthest + radius + 0.1F;
    Points centers;
    std::vector<std::size_t> near, in_sight;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Point center = aligned * grid_.middle_of(blocks[b]);
        if ((center - sensor).squaredNorm() > in_reach * in_reach) continue;
        centers.push_back(center);
        near.push_back(b);
    }
    Directions seen;
    to_spherical(centers, keyframe.T_sensor_map, seen);
    for (std::size_t i = 0; i < near.size(); ++i) {
        const Beam center{seen.azimuth[i], seen.elevation[i], seen.range[i]};
        if (may_see(keyframe.image, center, radius, margins)) in_sight.push_back(near[i]);
    }
    return in_sight;
}

/// The observation of each of the places.
std::vector<Sight> EvidenceMap::look(const Keyframe& keyframe, const Points& places) const {
    const SightMargins margins = margins_for(keyframe);
    Directions seen;
    to_spherical(places, keyframe.T_sensor_map, seen);
    std::vector<Sight> sights;
    check_lines_of_sight(keyframe.image, seen, margins, sights);
    return sights;
}

/// The same for places in blocks, most of which are out of view.
std::vector<Sight> EvidenceMap::look(const Keyframe& keyframe, const Places& places,
                                     const Eigen::Isometry3f& aligned) const {
    Points centroids;
    std::vector<std::size_t> at;
    for (const std::size_t b : blocks_in_sight(places.blocks, keyframe, aligned, 0.0F)) {
        for (std::size_t i = places.first[b]; i < places.first[b + 1]; ++i) {
            centroids.push_back(aligned * places.centroids[i]);
            at.push_back(i);
        }
    }
    const std::vector<Sight> seen = look(keyframe, centroids);
    std::vector<Sight> sights(places.voxels.size(), Sight::unknown);
    for (std::size_t i = 0; i < at.size(); ++i) sights[at[i]] = seen[i];
    return sights;
}

std::vector<std::vector<std::size_t>> EvidenceMap::free_keyframes(
    std::span<const std::uint32_t> voxels) const {
    std::vector<std::uint32_t> place(grid_.size(), kNoVoxel), blocks;  // index among `voxels`
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        place[voxels[i]] = static_cast<std::uint32_t>(i);
        blocks.push_back(grid_.voxels().block_of_voxel(voxels[i]));
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    const Places places =
        places_in(std::move(blocks), [&](std::uint32_t v) { return place[v] != kNoVoxel; });
    constexpr std::size_t kMostAsked = 64;
    const auto& kept = keyframes_.kept();
    const std::size_t stride =
        std::max<std::size_t>(1, (kept.size() + kMostAsked - 1) / kMostAsked);
    const std::size_t asked = kept.size() / stride;
    std::vector<std::vector<Sight>> sights(asked);
    const auto keyframe = [&](std::size_t k) -> const Keyframe& {
        return kept[stride * (k + 1) - 1];
    };
    parallel_for(asked, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) sights[k] = look(keyframe(k), places, kNotMoved);
    });
    std::vector<std::vector<std::size_t>> result(voxels.size());
    for (std::size_t k = 0; k < asked; ++k) {
        for (std::size_t i = 0; i < places.voxels.size(); ++i) {
            if (is_free(sights[k][i])) result[place[places.voxels[i]]].push_back(keyframe(k).index);
        }
    }
    return result;
}

void EvidenceMap::observe_again(std::span<const std::uint32_t> voxels,
                                const std::function<bool(const Keyframe&, const Point&)>& may_see) {
    parallel_for(voxels.size(), 1024, [&](std::size_t begin, std::size_t end) {
        const auto some = voxels.subspan(begin, end - begin);
        Points centroids;
        for (const std::uint32_t v : some) {
            centroids.push_back(grid_[v].centroid);
            grid_.forget_observations(v);
        }
        for (const Keyframe& keyframe : keyframes_.kept()) {
            const std::vector<Sight> sights = look(keyframe, centroids);
            for (std::size_t i = 0; i < some.size(); ++i) {
                if (sights[i] == Sight::unknown || !may_see(keyframe, centroids[i])) continue;
                grid_.record_again(some[i], sights[i]);
            }
        }
        for (const std::uint32_t v : some) grid_.update_score(v);
    });
}

}  // namespace dynamic_filter
