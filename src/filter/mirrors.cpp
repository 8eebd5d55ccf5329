// SPDX-License-Identifier: MIT
#include "filter/mirrors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

namespace {

constexpr float kDeep = 31.0F;           // [m] behind the plane
constexpr float kControl = 1.0F;         // [m] off the place in the mirror
constexpr std::size_t kMostPlanes = 16;  // that are tried
constexpr int kLeastRows = 40;           // of voxels in a plane
constexpr std::size_t kFewVoxels =
    50000;                             // that are looked at to find out whether a plane may be one
constexpr int kFew = 6, kEnough = 20;  // matches in a part of a plane
constexpr int kLeastLike = 250;        // matches in a mirror
constexpr std::size_t kSamples = 800;  // of a plane, for the same purpose

/// A voxel that was first seen through a plane.
struct SeenBehind {
    std::uint32_t voxel;
    std::size_t keyframe;  // at that time
    Crossing at;
};

/// What a place behind a plane has in front of it, at its place in the mirror.
enum class Likeness : std::uint8_t { unknown, like, unlike, plain };

/// Upright rows of voxels, from above.
std::vector<Eigen::Vector2f> upright_rows(const EvidenceGrid& grid) {
    std::vector<Eigen::Vector2f> out;
    for (std::uint32_t b = 0; b < grid.voxels().blocks(); ++b) {
        std::array<Eigen::Vector2f, 16> sum;
        std::array<int, 16> count{};
        grid.voxels().each_in_block(b, ~std::uint64_t{0}, [&](std::uint32_t v, int place) {
            const auto row = static_cast<std::size_t>(place / 4);
            const Eigen::Vector2f p = grid[v].centroid.head<2>();
            sum[row] = count[row]++ == 0 ? p : Eigen::Vector2f(sum[row] + p);
        });
        for (std::size_t row = 0; row < 16; ++row) {
            if (count[row] >= 3) out.emplace_back(sum[row] / static_cast<float>(count[row]));
        }
    }
    return out;
}

UprightPlane seen_from_behind(const UprightPlane& plane) {
    return {.normal = -plane.normal,
            .offset = -plane.offset,
            .from = -plane.until,
            .until = -plane.from};
}

/// Every `stride`-th voxel that was first seen through the plane, by keyframe.
std::vector<SeenBehind> seen_through(const UprightPlane& plane, const EvidenceMap& map,
                                     std::size_t stride) {
    const auto& keyframes = map.keyframes().kept();
    std::vector<SeenBehind> seen;
    for (std::size_t v = 0; v < map.grid().size(); v += stride) {
        const auto& state = map.grid()[static_cast<std::uint32_t>(v)];
        const std::uint32_t owner = state.evidence.first_owner;
        if (owner < keyframes.front().owner) continue;
        const auto at = crossing(plane, map.sensor_of_owner(owner), state.centroid);
        if (!at || at->along < plane.from || at->along > plane.until) continue;
        const auto next =
            std::upper_bound(keyframes.begin(), keyframes.end(), owner,
                             [](std::uint32_t o, const Keyframe& k) { return o < k.owner; });
        seen.push_back({static_cast<std::uint32_t>(v),
                        static_cast<std::size_t>(next - keyframes.begin() - 1), *at});
    }
    std::stable_sort(seen.begin(), seen.end(), [](const SeenBehind& a, const SeenBehind& b) {
        return a.keyframe < b.keyframe;
    });
    return seen;
}

/// What the keyframes of the voxels see `beyond` [m] before the places of the voxels in the mirror.
std::vector<Sight> sights_before(const UprightPlane& plane, const EvidenceMap& map,
                                 const std::vector<SeenBehind>& seen, float beyond) {
    const Point normal(plane.normal.x(), plane.normal.y(), 0.0F);
    std::vector<Sight> sights;
    for (std::size_t i = 0; i < seen.size();) {
        const std::size_t keyframe = seen[i].keyframe;
        Points places;
        for (; i < seen.size() && seen[i].keyframe == keyframe; ++i) {
            places.push_back(map.grid()[seen[i].voxel].centroid +
                             (2.0F * seen[i].at.depth + beyond) * normal);
        }
        const auto some = map.look(map.keyframes().kept()[keyframe], places);
        sights.insert(sights.end(), some.begin(), some.end());
    }
    return sights;
}

/// A floor, a ceiling and walls across the plane go on behind an open doorway as they would in a
/// mirror, so places that are occupied also a metre off the place in the mirror tell nothing.
std::vector<bool> plain_ones(const UprightPlane& plane, const EvidenceMap& map,
                             const std::vector<SeenBehind>& seen) {
    const auto nearer = sights_before(plane, map, seen, -kControl);
    const auto farther = sights_before(plane, map, seen, kControl);
    std::vector<bool> plain(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        plain[i] = is_occupied(nearer[i]) || is_occupied(farther[i]);
    }
    return plain;
}

std::vector<Likeness> likenesses(const UprightPlane& plane, const EvidenceMap& map,
                                 const std::vector<SeenBehind>& seen,
                                 const std::vector<bool>& plain) {
    const auto sights = sights_before(plane, map, seen, 0.0F);
    std::vector<Likeness> out(seen.size(), Likeness::unknown);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (is_free(sights[i])) out[i] = Likeness::unlike;
        if (is_occupied(sights[i])) out[i] = plain[i] ? Likeness::plain : Likeness::like;
    }
    return out;
}

/// Counts of a part of a plane.
struct Tally {
    int like = 0, unlike = 0, plain = 0;
    void add(const Tally& other) {
        like += other.like;
        unlike += other.unlike;
        plain += other.plain;
    }
    void add(Likeness likeness) {
        like += likeness == Likeness::like ? 1 : 0;
        unlike += likeness == Likeness::unlike ? 1 : 0;
        plain += likeness == Likeness::plain ? 1 : 0;
    }
    /// True also if nothing is known.
    [[nodiscard]] bool is_mostly_alike(double share) const {
        return like + plain >= share * (like + plain + unlike);
    }
};

/// Counts of a column of cells, also by metre behind the plane.
struct Column {
    Tally tally;
    std::array<int, 32> like_at{};
    void add(const Column& other) {
        tally.add(other.tally);
        for (std::size_t i = 0; i < like_at.size(); ++i) like_at[i] += other.like_at[i];
    }
    /// True if the share of places with their like is above `share`. One surface alone may have its
    /// like by chance, so most of them must not lie at one depth.
    [[nodiscard]] bool is_mirrored(double share, int least) const {
        int most = 0;
        for (std::size_t i = 1; i < like_at.size(); ++i) {
            most = std::max(most, like_at[i - 1] + like_at[i]);
        }
        return tally.like >= least && tally.like > share * (tally.like + tally.unlike) &&
               4 * most < 3 * tally.like;
    }
};

Mirror blank_mirror(const UprightPlane& plane, const std::vector<SeenBehind>& seen) {
    Mirror mirror{.plane = plane};
    mirror.lowest = seen.front().at.z;
    mirror.plane.from = mirror.plane.until = seen.front().at.along;
    float highest = mirror.lowest;
    for (const SeenBehind& s : seen) {
        mirror.lowest = std::min(mirror.lowest, s.at.z);
        highest = std::max(highest, s.at.z);
        mirror.plane.from = std::min(mirror.plane.from, s.at.along);
        mirror.plane.until = std::max(mirror.plane.until, s.at.along);
    }
    mirror.columns = static_cast<int>((mirror.plane.until - mirror.plane.from) / kMirrorCell) + 1;
    mirror.rows = static_cast<int>((highest - mirror.lowest) / kMirrorCell) + 1;
    mirror.reflects.assign(static_cast<std::size_t>(kMirrorAngles * mirror.rows * mirror.columns),
                           false);
    return mirror;
}

/// Sums over the cells up to two rows and columns away from each.
std::vector<Tally> around(const std::vector<Tally>& cells, const Mirror& m) {
    std::vector<Tally> sums(cells.size());
    for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
        const int column = i % m.columns, row = i / m.columns % m.rows;
        const int first = i - row * m.columns - column;  // cell of this angle
        for (int r = std::max(0, row - 2); r <= std::min(m.rows - 1, row + 2); ++r) {
            for (int c = std::max(0, column - 2); c <= std::min(m.columns - 1, column + 2); ++c) {
                sums[static_cast<std::size_t>(i)].add(
                    cells[static_cast<std::size_t>(first + r * m.columns + c)]);
            }
        }
    }
    return sums;
}

/// The columns of cells up to half a metre around each, by angle of incidence and column.
std::vector<Column> columns_of(const Mirror& m, const std::vector<SeenBehind>& seen,
                               const std::vector<Likeness>& likeness) {
    std::vector<Column> single(static_cast<std::size_t>(kMirrorAngles * m.columns));
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto cell = m.cell(seen[i].at.along, seen[i].at.z, seen[i].at.angle);
        if (!cell) continue;
        const int column = static_cast<int>(*cell) % m.columns + seen[i].at.angle * m.columns;
        Column& of = single[static_cast<std::size_t>(column)];
        of.tally.add(likeness[i]);
        if (likeness[i] == Likeness::like) ++of.like_at[static_cast<std::size_t>(seen[i].at.depth)];
    }
    std::vector<Column> sums(single.size());
    for (int i = 0; i < static_cast<int>(sums.size()); ++i) {
        for (int k = i - 2; k <= i + 2; ++k) {
            const bool is_same_angle =
                k >= 0 && k < static_cast<int>(sums.size()) && k / m.columns == i / m.columns;
            if (is_same_angle)
                sums[static_cast<std::size_t>(i)].add(single[static_cast<std::size_t>(k)]);
        }
    }
    return sums;
}

/// The floor in front of a mirror has its like behind an opening, too, so only what is seen above
/// it tells that a mirror goes down to the floor. A ceiling does not tell that it goes up.
void mark_down(Mirror& mirror, const std::vector<Tally>& near, double share) {
    for (std::size_t i = mirror.reflects.size(); i-- > 0;) {
        const auto row = static_cast<int>(i) / mirror.columns % mirror.rows;
        if (row + 1 == mirror.rows || mirror.reflects[i]) continue;
        const bool goes_on = mirror.reflects[i + static_cast<std::size_t>(mirror.columns)];
        if (goes_on && near[i].is_mostly_alike(share)) mirror.reflects[i] = true;
    }
}

/// The sums over all angles of incidence, for each of them.
std::vector<Tally> at_any_angle(const std::vector<Tally>& tallies) {
    const std::size_t cells = tallies.size() / kMirrorAngles;
    std::vector<Tally> sums(tallies.size());
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        for (std::size_t k = i % cells; k < tallies.size(); k += cells) sums[i].add(tallies[k]);
    }
    return sums;
}

/// What reflects at some angle reflects at a more grazing one, too, unless that was seen otherwise.
void mark_grazing(Mirror& mirror, const std::vector<Column>& columns) {
    const std::size_t cells = mirror.reflects.size() / kMirrorAngles;
    const auto width = static_cast<std::size_t>(mirror.columns);
    for (std::size_t i = cells; i < mirror.reflects.size(); ++i) {
        const Tally& column = columns[i / cells * width + i % width].tally;
        if (mirror.reflects[i - cells] && column.unlike <= column.like) mirror.reflects[i] = true;
    }
}

/// Marks the cells that reflect, and tells how well: each place without its like counts against
/// four that have theirs, because they are few only where the plane is exact.
int mark(Mirror& mirror, const std::vector<SeenBehind>& seen, const std::vector<Likeness>& likeness,
         double share, int least) {
    const std::vector<Column> columns = columns_of(mirror, seen, likeness);
    const auto is_mirrored = [&](const Column& c) { return c.is_mirrored(share, least); };
    if (std::none_of(columns.begin(), columns.end(), is_mirrored)) return 0;  // nearly always
    std::vector<bool> column_reflects(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) column_reflects[i] = is_mirrored(columns[i]);

    std::vector<Tally> cells(mirror.reflects.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto cell = mirror.cell(seen[i].at.along, seen[i].at.z, seen[i].at.angle);
        if (cell) cells[*cell].add(likeness[i]);
    }
    const std::vector<Tally> near = around(cells, mirror), near_at_any_angle = at_any_angle(near);
    const auto width = static_cast<std::size_t>(mirror.columns);
    const std::size_t of_angle = cells.size() / kMirrorAngles;
    int like = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        mirror.reflects[i] = column_reflects[i / of_angle * width + i % width] &&
                             near_at_any_angle[i].like > 0 && near[i].is_mostly_alike(share) &&
                             cells[i].is_mostly_alike(share);
        if (mirror.reflects[i]) like += cells[i].like - 4 * cells[i].unlike;
    }
    mark_down(mirror, near, share);
    mark_grazing(mirror, columns);
    return std::max(like, 0);
}

/// The plane turned about a place [m] along it, and moved to the front [m].
UprightPlane turned(const UprightPlane& plane, float along, float angle, float moved) {
    const Eigen::Vector2f axis(-plane.normal.y(), plane.normal.x());
    const Eigen::Vector2f hinge = plane.offset * plane.normal + along * axis;
    UprightPlane out = plane;
    out.normal = Eigen::Rotation2Df(angle) * plane.normal;
    const float shifted = out.along(hinge) - along;
    out.from += shifted;
    out.until += shifted;
    out.offset = out.normal.dot(hinge) + moved;
    return out;
}

/// A mirror and the number of places behind it that have their like.
struct Found {
    Mirror mirror;
    int like = 0;
};

/// The mirror in exactly this plane, from some of the voxels that were seen through it.
Found mirror_at(const UprightPlane& plane, const EvidenceMap& map, std::vector<SeenBehind> seen,
                const std::vector<bool>& plain, double share, int least) {
    for (SeenBehind& s : seen) {
        const auto& state = map.grid()[s.voxel];
        const Point& sensor = map.sensor_of_owner(state.evidence.first_owner);
        // It stays where it was if it is no longer behind the plane, which only few are.
        s.at = crossing(plane, sensor, state.centroid).value_or(s.at);
    }
    Found found{blank_mirror(plane, seen)};
    found.like = mark(found.mirror, seen, likenesses(plane, map, seen, plain), share, least);
    return found;
}

/// The mirror in one of the planes nearby that has the most places with their like.
Found best_mirror(const UprightPlane& plane, const EvidenceMap& map,
                  const std::vector<SeenBehind>& seen, std::span<const float> angles,
                  std::span<const float> moves, double share, int least) {
    float along = 0.0F;
    for (const SeenBehind& s : seen) along += s.at.along / static_cast<float>(seen.size());
    const auto plain = plain_ones(plane, map, seen);
    Found best;
    for (const float angle : angles) {
        for (const float moved : moves) {
            Found found =
                mirror_at(turned(plane, along, angle, moved), map, seen, plain, share, least);
            if (found.like > best.like) best = std::move(found);
        }
    }
    return best;
}

/// At most `most` of the voxels, evenly chosen.
std::vector<SeenBehind> some_of(const std::vector<SeenBehind>& seen, std::size_t most) {
    const std::size_t stride = std::max<std::size_t>(1, (seen.size() + most - 1) / most);
    std::vector<SeenBehind> some;
    for (std::size_t i = 0; i < seen.size(); i += stride) some.push_back(seen[i]);
    return some;
}

/// True if keyframes from behind the mirror saw most of what is seen in it: then it is an opening,
/// with the same on both sides.
bool is_real_behind(const Mirror& mirror, const EvidenceMap& map,
                    const std::vector<SeenBehind>& seen) {
    constexpr std::size_t kMostKeyframes = 20, kMostPlaces = 500;
    std::vector<SeenBehind> reflected;
    for (const SeenBehind& s : seen) {
        const auto cell = mirror.cell(s.at.along, s.at.z, s.at.angle);
        if (cell && mirror.reflects[*cell]) reflected.push_back(s);
    }
    Points places;
    for (const SeenBehind& s : some_of(reflected, kMostPlaces)) {
        places.push_back(map.grid()[s.voxel].centroid);
    }
    std::vector<const Keyframe*> behind;
    for (const Keyframe& k : map.keyframes().kept()) {
        const Point sensor = map.sensor_of_owner(k.owner);
        if (mirror.plane.height(sensor.head<2>()) < -kBehindMirror) behind.push_back(&k);
    }
    const std::size_t stride = behind.size() / kMostKeyframes + 1;
    int occupied = 0, free = 0;
    for (std::size_t k = 0; k < behind.size(); k += stride) {
        for (const Sight sight : map.look(*behind[k], places)) {
            occupied += is_occupied(sight) ? 1 : 0;
            free += is_free(sight) ? 1 : 0;
        }
    }
    return occupied > free;
}

/// The mirror in the plane or very near it, if there is one.
std::optional<Mirror> mirror_in(const UprightPlane& plane, const EvidenceMap& map, double share) {
    constexpr float kDegree = 0.0174533F;
    // Few voxels tell whether it may be worth to look at many of them.
    const auto few =
        some_of(seen_through(plane, map, map.grid().size() / kFewVoxels + 1), kSamples);
    if (few.size() < kFew) return std::nullopt;
    constexpr std::array kStraight = {0.0F};
    constexpr std::array kMoves = {0.0F, -0.1F, 0.1F, -0.2F, 0.2F};
    const Found coarse = best_mirror(plane, map, few, kStraight, kMoves, 0.8 * share, kFew);
    if (coarse.like < kFew) return std::nullopt;

    const auto seen = seen_through(coarse.mirror.plane, map, 1);
    if (seen.size() < kFew) return std::nullopt;
    const auto many = some_of(seen, 8 * kSamples);
    constexpr std::array kTurns = {0.0F,    -0.5F * kDegree, 0.5F * kDegree, -kDegree,
                                   kDegree, -1.5F * kDegree, 1.5F * kDegree};
    constexpr std::array kSteps = {0.0F, -0.05F, 0.05F};
    const Found better = best_mirror(coarse.mirror.plane, map, many, kTurns, kSteps, share, kFew);
    if (better.like < kFew) return std::nullopt;
    const auto plain = plain_ones(better.mirror.plane, map, seen);
    Found exact = mirror_at(better.mirror.plane, map, seen, plain, share, kEnough);
    if (exact.like < kLeastLike || is_real_behind(exact.mirror, map, seen)) return std::nullopt;
    // Where there is a mirror, fewer places tell how far it goes.
    return mirror_at(exact.mirror.plane, map, seen, plain, share, kFew).mirror;
}

}  // namespace

std::optional<std::size_t> Mirror::cell(float along, float z, int angle) const {
    const int column = static_cast<int>(std::floor((along - plane.from) / kMirrorCell));
    const int row = static_cast<int>(std::floor((z - lowest) / kMirrorCell));
    if (column < 0 || column >= columns || row < 0 || row >= rows) return std::nullopt;
    return static_cast<std::size_t>((angle * rows + row) * columns + column);
}

std::optional<Crossing> crossing(const UprightPlane& plane, const Point& sensor, const Point& point,
                                 float least) {
    const float front = plane.height(sensor.head<2>()), behind = -plane.height(point.head<2>());
    if (front < kBehindMirror || behind < least || behind > kDeep) return std::nullopt;
    const Point way = point - sensor;
    const Point at = sensor + front / (front + behind) * way;
    const float cosine = (front + behind) / way.norm();
    return Crossing{plane.along(at.head<2>()), at.z(), behind,
                    cosine > 0.7F    ? 0
                    : cosine > 0.35F ? 1
                                     : 2};
}

bool is_reflected(const Mirror& mirror, const Point& sensor, const Point& point, float least) {
    const auto at = crossing(mirror.plane, sensor, point, least);
    if (!at) return false;
    const auto cell = mirror.cell(at->along, at->z, at->angle);
    return cell && mirror.reflects[*cell];
}

bool is_on(const Mirror& mirror, const Point& point) {
    constexpr float kNear = 0.15F;  // [m]
    if (std::abs(mirror.plane.height(point.head<2>())) > kNear) return false;
    const float along = mirror.plane.along(point.head<2>());
    for (int angle = 0; angle < kMirrorAngles; ++angle) {
        const auto cell = mirror.cell(along, point.z(), angle);
        if (cell && mirror.reflects[*cell]) return true;
    }
    return false;
}

bool is_reflected(const std::vector<Mirror>& mirrors, const Point& sensor, const Point& point,
                  float least) {
    return std::any_of(mirrors.begin(), mirrors.end(),
                       [&](const Mirror& m) { return is_reflected(m, sensor, point, least); });
}

bool is_on(const std::vector<Mirror>& mirrors, const Point& point) {
    return std::any_of(mirrors.begin(), mirrors.end(),
                       [&](const Mirror& m) { return is_on(m, point); });
}

void observe_behind(const std::vector<Mirror>& mirrors, EvidenceMap& map) {
    constexpr float kLeast = 0.05F;  // [m] also the back of a thin wall with a mirror
    const auto& kept = map.keyframes().kept();
    std::vector<std::uint8_t> is_behind(map.grid().size());
    parallel_for(is_behind.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const Point& p = map.grid()[static_cast<std::uint32_t>(v)].centroid;
            is_behind[v] = std::any_of(kept.begin(), kept.end(), [&](const Keyframe& k) {
                return is_reflected(mirrors, map.sensor_of_owner(k.owner), p, kLeast);
            });
        }
    });
    std::vector<std::uint32_t> behind;
    for (std::uint32_t v = 0; v < is_behind.size(); ++v) {
        if (is_behind[v] != 0) behind.push_back(v);
    }
    map.observe_again(behind, [&](const Keyframe& k, const Point& p) {
        return !is_reflected(mirrors, map.sensor_of_owner(k.owner), p, kLeast);
    });
}

std::vector<Mirror> find_mirrors(const EvidenceMap& map, const ScansConfig::Mirrors& config) {
    std::vector<Mirror> mirrors;
    if (map.keyframes().kept().empty() || config.matched >= 1.0) return mirrors;
    std::vector<UprightPlane> planes =
        upright_planes(upright_rows(map.grid()), kMostPlanes, kLeastRows);
    for (std::size_t i = planes.size(); i-- > 0;) planes.push_back(seen_from_behind(planes[i]));
    std::vector<std::optional<Mirror>> found(planes.size());
    parallel_for(planes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            found[i] = mirror_in(planes[i], map, config.matched);
    });
    for (auto& mirror : found) {
        if (mirror) mirrors.push_back(std::move(*mirror));
    }
    return mirrors;
}

}  // namespace dynamic_filter
