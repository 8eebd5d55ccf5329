// SPDX-License-Identifier: MIT
#include "filter/mirrors.hpp"

#include <algorithm>
#include <array>

#include "dynamic_filter/parallel.hpp"
#include "filter/mirror_cells.hpp"
#include "filter/upright_planes.hpp"

namespace dynamic_filter {

namespace {

constexpr float kControl = 1.0F;         // [m] off the place in the mirror
constexpr std::size_t kMostPlanes = 16;  // that are tried
constexpr int kLeastRows = 40;           // of voxels in a plane
constexpr std::size_t kFewVoxels =
    50000;                             // that are looked at to find out whether a plane may be one
constexpr int kFew = 6, kEnough = 20;  // matches in a part of a plane
constexpr int kLeastLike = 250;        // matches in a mirror in which something moves, too,
constexpr int kLeastAtRest = 1000;     // and in one in which nothing does
constexpr std::size_t kSamples = 800;  // of a plane, for the same purpose

/// A voxel that was first seen through a plane.
struct SeenBehind {
    std::uint32_t voxel;
    std::size_t keyframe;  // at that time
    Crossing at;
};

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

/// The keyframe at the time of a scan; empty if it is no longer kept.
std::optional<std::size_t> keyframe_of(const EvidenceMap& map, std::uint32_t owner) {
    const auto& keyframes = map.keyframes().kept();
    if (owner < keyframes.front().owner) return std::nullopt;
    const auto next =
        std::upper_bound(keyframes.begin(), keyframes.end(), owner,
                         [](std::uint32_t o, const Keyframe& k) { return o < k.owner; });
    return static_cast<std::size_t>(next - keyframes.begin() - 1);
}

/// Every `stride`-th voxel that was first seen through the plane, by keyframe.
std::vector<SeenBehind> seen_through(const UprightPlane& plane, const EvidenceMap& map,
                                     std::size_t stride) {
    std::vector<SeenBehind> seen;
    for (std::size_t v = 0; v < map.grid().size(); v += stride) {
        const auto& state = map.grid()[static_cast<std::uint32_t>(v)];
        const std::uint32_t owner = state.evidence.first_owner;
        const auto keyframe = keyframe_of(map, owner);
        if (!keyframe) continue;
        const auto at = crossing(plane, map.sensor_of_owner(owner), state.centroid);
        if (!at || at->along < plane.from || at->along > plane.until) continue;
        seen.push_back({static_cast<std::uint32_t>(v), *keyframe, *at});
    }
    std::stable_sort(seen.begin(), seen.end(), [](const SeenBehind& a, const SeenBehind& b) {
        return a.keyframe < b.keyframe;
    });
    return seen;
}

/// A place about which a keyframe is asked.
struct Question {
    std::size_t keyframe;
    Point place;  ///< [m]
};

/// What the keyframes see at the places; questions to one keyframe should stand together.
std::vector<Sight> answers(const EvidenceMap& map, const std::vector<Question>& questions) {
    std::vector<Sight> sights;
    for (std::size_t i = 0; i < questions.size();) {
        const std::size_t keyframe = questions[i].keyframe;
        Points places;
        for (; i < questions.size() && questions[i].keyframe == keyframe; ++i) {
            places.push_back(questions[i].place);
        }
        const auto some = map.look(map.keyframes().kept()[keyframe], places);
        sights.insert(sights.end(), some.begin(), some.end());
    }
    return sights;
}

Point upright_normal(const UprightPlane& plane) {
    return {plane.normal.x(), plane.normal.y(), 0.0F};
}

/// What the keyframes of the voxels see `beyond` [m] before the places of the voxels in the mirror.
std::vector<Sight> sights_before(const UprightPlane& plane, const EvidenceMap& map,
                                 const std::vector<SeenBehind>& seen, float beyond) {
    std::vector<Question> questions;
    for (const SeenBehind& s : seen) {
        const Point& behind = map.grid()[s.voxel].centroid;
        questions.push_back(
            {s.keyframe, behind + (2.0F * s.at.depth + beyond) * upright_normal(plane)});
    }
    return answers(map, questions);
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

/// The mirror in exactly this plane, from some of the voxels that were seen through it.
MarkedMirror mirror_at(const UprightPlane& plane, const EvidenceMap& map,
                       std::vector<SeenBehind> seen, const std::vector<bool>& plain, double share,
                       int least) {
    std::vector<Crossing> crossings;
    for (SeenBehind& s : seen) {
        const auto& state = map.grid()[s.voxel];
        const Point& sensor = map.sensor_of_owner(state.evidence.first_owner);
        // It stays where it was if it is no longer behind the plane, which only few are.
        s.at = crossing(plane, sensor, state.centroid).value_or(s.at);
        crossings.push_back(s.at);
    }
    return mark_mirror(plane, crossings, likenesses(plane, map, seen, plain), share, least);
}

/// The mirror in one of the planes nearby that has the most places with their like.
MarkedMirror best_mirror(const UprightPlane& plane, const EvidenceMap& map,
                         const std::vector<SeenBehind>& seen, std::span<const float> angles,
                         std::span<const float> moves, double share, int least) {
    float along = 0.0F;
    for (const SeenBehind& s : seen) along += s.at.along / static_cast<float>(seen.size());
    const auto plain = plain_ones(plane, map, seen);
    MarkedMirror best;
    for (const float angle : angles) {
        for (const float moved : moves) {
            MarkedMirror found =
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

/// Those that were seen where the mirror reflects.
std::vector<SeenBehind> reflected_ones(const Mirror& mirror, const std::vector<SeenBehind>& seen) {
    std::vector<SeenBehind> reflected;
    for (const SeenBehind& s : seen) {
        const auto cell = mirror.cell(s.at.along, s.at.z, s.at.angle);
        if (cell && mirror.reflects[*cell]) reflected.push_back(s);
    }
    return reflected;
}

/// True if keyframes from behind the mirror saw most of what is seen in it: then it is an opening,
/// with the same on both sides.
bool is_real_behind(const Mirror& mirror, const EvidenceMap& map,
                    const std::vector<SeenBehind>& seen) {
    constexpr std::size_t kMostKeyframes = 20, kMostPlaces = 500;
    const std::vector<SeenBehind> reflected = reflected_ones(mirror, seen);
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

/// True if the voxel was mostly empty: something crossed it.
bool was_crossed(const Evidence& e) { return e.n_free >= 3 && e.n_free > 2 * e.n_occ; }

/// Places in the mirror of what moved before it, at the times at which that was there.
std::vector<Question> images_of_what_moved(const Mirror& mirror, const EvidenceMap& map) {
    std::vector<Question> images;
    for (std::uint32_t v = 0; v < map.grid().size(); ++v) {
        const auto& state = map.grid()[v];
        const float before = mirror.plane.height(state.centroid.head<2>());
        if (before < kBehindMirror || !was_crossed(state.evidence)) continue;
        const std::uint32_t owner = state.evidence.first_owner;
        const auto keyframe = keyframe_of(map, owner);
        const Point image = state.centroid - 2.0F * before * upright_normal(mirror.plane);
        if (keyframe && is_reflected(mirror, map.sensor_of_owner(owner), image)) {
            images.push_back({*keyframe, image});
        }
    }
    std::stable_sort(images.begin(), images.end(),
                     [](const Question& a, const Question& b) { return a.keyframe < b.keyframe; });
    return images;
}

/// What moves on one side moves on the other at the same time, if it is a mirror. In an opening
/// between places that look alike, such as the two halves of a building, it does not.
enum class Motion { unseen, alike, otherwise };

Motion motion_in(const Mirror& mirror, const EvidenceMap& map,
                 const std::vector<SeenBehind>& seen) {
    constexpr int kTelling = 20;
    std::vector<SeenBehind> moved = reflected_ones(mirror, seen);
    std::erase_if(moved,
                  [&](const SeenBehind& s) { return !was_crossed(map.grid()[s.voxel].evidence); });
    int like = 0, unlike = 0;
    const auto count = [&](const std::vector<Sight>& sights) {
        for (const Sight sight : sights) {
            like += is_occupied(sight) ? 1 : 0;
            unlike += is_free(sight) ? 1 : 0;
        }
    };
    count(sights_before(mirror.plane, map, moved, 0.0F));
    count(answers(map, images_of_what_moved(mirror, map)));
    if (std::max(like, unlike) < kTelling) return Motion::unseen;
    return like > unlike ? Motion::alike : Motion::otherwise;
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
    const MarkedMirror coarse = best_mirror(plane, map, few, kStraight, kMoves, 0.8 * share, kFew);
    if (coarse.like < kFew) return std::nullopt;

    const auto seen = seen_through(coarse.mirror.plane, map, 1);
    if (seen.size() < kFew) return std::nullopt;
    const auto many = some_of(seen, 8 * kSamples);
    constexpr std::array kTurns = {0.0F,    -0.5F * kDegree, 0.5F * kDegree, -kDegree,
                                   kDegree, -1.5F * kDegree, 1.5F * kDegree};
    constexpr std::array kSteps = {0.0F, -0.05F, 0.05F};
    const MarkedMirror better =
        best_mirror(coarse.mirror.plane, map, many, kTurns, kSteps, share, kFew);
    if (better.like < kFew) return std::nullopt;
    const auto plain = plain_ones(better.mirror.plane, map, seen);
    MarkedMirror exact = mirror_at(better.mirror.plane, map, seen, plain, share, kEnough);
    if (exact.like < kLeastLike || is_real_behind(exact.mirror, map, seen)) return std::nullopt;
    const Motion motion = motion_in(exact.mirror, map, seen);
    if (motion == Motion::otherwise) return std::nullopt;
    if (motion == Motion::unseen && exact.like < kLeastAtRest) return std::nullopt;
    // Where there is a mirror, fewer places tell how far it goes.
    return mirror_at(exact.mirror.plane, map, seen, plain, share, kFew).mirror;
}

}  // namespace

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
