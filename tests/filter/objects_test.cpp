// SPDX-License-Identifier: MIT
#include "filter/objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamic_filter/filter.hpp"

namespace dynamic_filter {
namespace objects_test {

/// Ground 1.8 m below the sensor, a bench, and a person at `x` who may walk into it.
struct Glance {
    Scan scan;
    std::vector<bool> person, bench;

    explicit Glance(double stamp) {
        scan.stamp = stamp;
        for (float u = -8.0F; u < 8.0F; u += 0.4F) {
            for (float v = -8.0F; v < 8.0F; v += 0.4F) add({u, v, -1.8F});
        }
    }
    Glance(double stamp, float x) : Glance(stamp) {
        add_box({5.0F, 3.0F, -1.8F}, {6.5F, 3.4F, -1.0F}, bench);
        add_box({x, 3.05F, -1.8F}, {x + 0.5F, 3.45F, -0.1F}, person);
    }
    void add(const Point& p) {
        scan.points.push_back(p);
        person.push_back(false);
        bench.push_back(false);
    }
    void add_box(const Point& low, const Point& high, std::vector<bool>& kind) {
        for (float x = low.x(); x <= high.x(); x += 0.1F) {
            for (float y = low.y(); y <= high.y(); y += 0.1F) {
                for (float z = low.z(); z <= high.z(); z += 0.1F) {
                    add({x, y, z});
                    kind.back() = true;
                }
            }
        }
    }
};

struct Followed {
    EvidenceMap map{Config{}};
    EvidenceGrid& grid = map.grid();
    Objects instances{ScansConfig{}.instances};
    PointVoxels voxels;
    Labels labels;

    /// The instant verdicts call the person dynamic, or not. `seen_free`: earlier scans saw free
    /// what the person fills for the first time.
    void see(const Glance& sight, bool person_is_dynamic, bool seen_free = false) {
        voxels = grid.add_points(sight.scan);
        for (std::size_t i = 0; seen_free && i < voxels.size(); ++i) {
            if (!sight.person[i] || grid[voxels[i]].evidence.n_occ > 0) continue;
            grid.record(voxels[i], Sight::free, 1, false);
            grid.record(voxels[i], Sight::occupied, 1, true);
        }
        labels.assign(sight.scan.points.size(), Label::static_);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (sight.person[i] && person_is_dynamic) labels[i] = Label::dynamic;
        }
        const auto clusters = instances.clusters_in(sight.scan, voxels);
        if (clusters) instances.update(sight.scan, voxels, *clusters, map, labels);
    }
    /// The least and the greatest share of scans in which voxels of the points moved.
    [[nodiscard]] std::pair<float, float> moved(const Glance& sight,
                                                const std::vector<bool>& of) const {
        float least = 1.0F, most = 0.0F;
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (!of[i] || sight.scan.points[i].z() < -1.3F) continue;
            const Evidence& e = grid[voxels[i]].evidence;
            const float share = static_cast<float>(e.moved) / static_cast<float>(e.n_own);
            least = std::min(least, share);
            most = std::max(most, share);
        }
        return {least, most};
    }
};

std::ptrdiff_t dynamic_points(const Followed& f, const std::vector<bool>& of) {
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < of.size(); ++i) count += of[i] && f.labels[i] == Label::dynamic;
    return count;
}

TEST(Objects, WhoWasSeenToComeIsDynamicWhileAtRest) {
    Followed f;
    for (int i = 0; i < 8; ++i) f.see({0.2 * i, -4.0F + 0.3F * static_cast<float>(i)}, true);
    for (int i = 8; i < 60; ++i) f.see({0.2 * i, -1.9F}, false);
    const Glance last(12.0, -1.9F);
    f.see(last, false);
    EXPECT_GT(10 * dynamic_points(f, last.person),
              8 * std::count(last.person.begin(), last.person.end(), true));
    EXPECT_EQ(dynamic_points(f, last.bench), 0);
    EXPECT_GT(f.moved(last, last.person).first, 0.9F);
    EXPECT_EQ(f.moved(last, last.bench).second, 0.0F);
}

TEST(Objects, WhoLeavesWasDynamicBefore) {
    Followed f;
    for (int i = 0; i < 10; ++i) f.see({0.2 * i, -4.0F}, false);
    const Glance there(2.0, -4.0F);
    f.see(there, false);
    const PointVoxels resting = f.voxels;
    for (int i = 11; i < 20; ++i) f.see({0.2 * i, -4.0F + 0.3F * static_cast<float>(i - 10)}, true);
    f.voxels = resting;
    EXPECT_GT(f.moved(there, there.person).first, 0.7F);
    EXPECT_LE(f.moved(there, there.person).second, 1.0F);
}

TEST(Objects, WhatOnlyFlickersWhereItIsDoesNotMove) {
    Followed f;
    for (int i = 0; i < 30; ++i) f.see({0.2 * i, -4.0F}, true);
    const Glance last(6.0, -4.0F);
    f.see(last, true);
    EXPECT_EQ(f.moved(last, last.person).second, 0.0F);
}

// They are one cluster for a while; the bench was there before.
TEST(Objects, ABenchThatAPersonBrushesStaysStatic) {
    Followed f;
    float x = 1.0F;
    for (int i = 0; i < 50; ++i, x += 0.2F) f.see({0.2 * i, x}, true);
    const Glance last(10.0, x);
    f.see(last, true);
    EXPECT_EQ(dynamic_points(f, last.bench), 0);
    EXPECT_LT(f.moved(last, last.bench).second, 0.5F);
}

// Nobody saw it come, and no voxel is dynamic by itself.
TEST(Objects, WhatStandsWhereAllWasFreeIsDynamic) {
    for (const bool seen_free : {false, true}) {
        Followed f;
        for (int i = 0; i < 5; ++i) f.see({0.2 * i, -40.0F}, false);
        for (int i = 5; i < 15; ++i) f.see({0.2 * i, 4.2F}, false, seen_free);
        const Glance last(3.0, 4.2F);
        f.see(last, false);
        EXPECT_EQ(dynamic_points(f, last.person) > 0, seen_free);
        EXPECT_EQ(f.moved(last, last.person).first > 0.9F, seen_free);
        EXPECT_EQ(dynamic_points(f, last.bench), 0);
    }
}

// What opens and closes was there before.
TEST(Objects, WhatIsSeenThroughNowAndThenIsNotFilled) {
    Followed f;
    for (int i = 0; i < 10; ++i) {
        const Glance sight(0.2 * i, -4.0F);
        f.see(sight, false, true);
        for (std::size_t k = 0; k < sight.person.size(); ++k) {
            if (!sight.person[k] || i > 0) continue;
            f.grid.record(f.voxels[k], Sight::free, 1, false);
            f.grid.record(f.voxels[k], Sight::occupied, 1, false);
        }
    }
    const Glance last(2.0, -4.0F);
    f.see(last, false);
    EXPECT_EQ(dynamic_points(f, last.person), 0);
}

// From afar only its front was followed; the whole is too large for the same track.
TEST(Objects, WhatStandsWhereATrackEndedIsKnownAtOnce) {
    for (const float width : {0.3F, 0.0F}) {  // [m] of the front; 0: nothing was followed
        Followed f;
        for (int i = 0; i < 8 && width > 0.0F; ++i) {
            Glance sight(0.2 * i);
            const float x = -6.0F + 0.3F * static_cast<float>(i);
            sight.add_box({x, 3.0F, -1.5F}, {x + 0.3F, 3.0F + width, -1.2F}, sight.person);
            f.see(sight, true, true);
        }
        Glance whole(1.6);
        whole.add_box({-5.4F, 3.0F, -1.5F}, {-3.9F, 4.2F, -0.4F}, whole.person);
        f.see(whole, false, true);
        EXPECT_EQ(dynamic_points(f, whole.person) > 0, width > 0.0F) << width;
    }
}

// Its front stood there before the rest of it came into view.
TEST(Objects, ANewPartOfAMovingObjectIsDynamicSinceItMoved) {
    Followed f;
    const auto with_front = [](int i) {
        Glance sight(0.2 * i);
        const float x = -6.0F + 0.3F * static_cast<float>(std::min(i, 7));
        sight.add_box({x, 3.0F, -1.5F}, {x + 0.3F, 3.3F, -1.2F}, sight.person);
        return sight;
    };
    for (int i = 0; i < 11; ++i) f.see(with_front(i), i < 8, true);
    const Glance front = with_front(10);
    const PointVoxels of_front = f.voxels;
    for (int i = 11; i < 30; ++i) {
        Glance whole(0.2 * i);
        whole.add_box({-5.4F, 3.0F, -1.5F}, {-3.6F, 4.2F, -0.4F}, whole.person);
        f.see(whole, false, true);
    }
    f.voxels = of_front;
    float least = 1.0F;
    for (std::size_t i = 0; i < of_front.size(); ++i) {
        if (!front.person[i]) continue;
        const Evidence& e = f.grid[of_front[i]].evidence;
        least = std::min(least, static_cast<float>(e.moved) / static_cast<float>(e.n_own));
    }
    EXPECT_GT(least, 0.8F);
}

// Two fifths of its voxels were seen free before: too few in one scan, and enough in many.
TEST(Objects, WeakSignsOfAnArrivalAddUp) {
    for (const bool seen_free : {false, true}) {
        Followed f;
        f.see(Glance(0.0), false);
        for (int i = 1; i < 30; ++i) {
            Glance sight(0.2 * i);
            sight.add_box({-5.4F, 3.0F, -1.5F}, {-4.8F, 4.2F, -0.4F}, sight.person);
            sight.add_box({-4.7F, 3.0F, -1.5F}, {-3.9F, 4.2F, -0.4F}, sight.bench);
            f.see(sight, false, seen_free);
            const bool is_known = dynamic_points(f, sight.bench) > 0;
            if (i <= 6 || i == 29) {
                EXPECT_EQ(is_known, seen_free && i == 29) << i;
            }
        }
    }
}

// The middle of a bus moves by more than that of two objects that touch may.
TEST(Objects, ABusIsFollowedAsMoreOfItComesIntoView) {
    for (const float step : {1.5F, 6.0F}) {  // [m] that the middle moves by
        Followed f;
        Glance sight(0.0);
        for (int i = 0; i < 20; ++i) {
            sight = Glance(0.2 * i);
            const float front = -6.0F + 0.4F * static_cast<float>(std::min(i, 8));
            const float length = i < 12 ? 8.0F : 8.0F + 2.0F * step;
            sight.add_box({front, 3.0F, -1.5F}, {front + length, 3.2F, 0.5F}, sight.person);
            f.see(sight, i < 9);
        }
        EXPECT_EQ(dynamic_points(f, sight.person) > 0, step < 2.0F) << step;
    }
}

// A box of 4 m creeps at 0.1 m/s. The middle of its place stays occupied, and no verdict of a voxel
// tells that it moves.
TEST(Objects, WhatCreepsIsFoundByItsSurface) {
    const auto at = [](int i, float speed) {
        Glance glance(0.2 * i);
        const float x = 1.0F + speed * 0.2F * static_cast<float>(i);
        // The sides that the sensor sees.
        glance.add_box({x, 4.0F, -1.8F}, {x + 4.0F, 4.0F, -0.4F}, glance.person);
        glance.add_box({x, 4.0F, -1.8F}, {x, 5.6F, -0.4F}, glance.person);
        for (const float still : {-5.0F, -2.0F}) {
            glance.add_box({still, 6.0F, -1.8F}, {still + 1.5F, 6.0F, -0.6F}, glance.bench);
            glance.add_box({-6.0F, still, -1.8F}, {-6.0F, still + 1.5F, -0.6F}, glance.bench);
        }
        return glance;
    };
    for (const float speed : {0.0F, 0.1F}) {
        Followed f;
        for (int i = 0; i < 30; ++i) f.see(at(i, speed), false);
        const Glance last = at(30, speed);
        f.see(last, false);
        const auto all = std::count(last.person.begin(), last.person.end(), true);
        if (speed > 0.0F) {
            EXPECT_GT(10 * dynamic_points(f, last.person), 7 * all);
            EXPECT_GT(f.moved(last, last.person).first, 0.7F);
        } else {
            EXPECT_EQ(dynamic_points(f, last.person), 0);
        }
        EXPECT_EQ(dynamic_points(f, last.bench), 0);
        EXPECT_EQ(f.moved(last, last.bench).second, 0.0F);
    }
}

// Something hides the object until its track is lost; only an end of it comes into view again.
TEST(Objects, APartOfAMovingObjectIsKnownWhenItComesIntoViewAgain) {
    Followed f;
    for (int i = 0; i < 8; ++i) f.see({0.2 * i, -4.0F + 0.3F * static_cast<float>(i)}, true);
    for (int i = 8; i < 12; ++i) f.see({0.2 * i, -1.9F}, false);
    f.see(Glance(4.0), false);
    Glance part(6.0);
    part.add_box({-1.9F, 3.05F, -1.8F}, {-1.4F, 3.25F, -0.4F}, part.person);
    f.see(part, false);
    EXPECT_GT(dynamic_points(f, part.person), 0);
}

/// What 64 beams see of a road between two walls, from 1.7 m above it, and of the back of a van at
/// `x` ahead.
struct Road {
    Scan scan;
    std::vector<bool> van;

    Road(std::size_t index, double stamp, float sensor, float x) {
        scan.index = index;
        scan.stamp = stamp;
        scan.T_world_sensor.translation().x() = sensor;
        scan.has_pose = true;
        for (int beam = 0; beam < 64; ++beam) {
            for (int column = 0; column < 720; ++column) {
                add(std::numbers::pi_v<float> * static_cast<float>(column) / 360.0F,
                    (static_cast<float>(beam) * 0.6F - 25.0F) * std::numbers::pi_v<float> / 180.0F,
                    x - sensor);
            }
        }
    }
    void add(float azimuth, float elevation, float ahead) {
        const Point ray(std::cos(elevation) * std::cos(azimuth),
                        std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        float range = 6.0F / std::abs(ray.y());
        if (ray.z() < 0.0F) range = std::min(range, -1.7F / ray.z());
        const Point back = ahead / ray.x() * ray;
        const bool is_van = ray.x() > 0.0F && ahead / ray.x() < range &&
                            std::abs(back.y()) < 0.9F && back.z() < 0.5F && back.z() > -1.4F;
        if (!is_van && range > 60.0F) return;
        scan.points.push_back(is_van ? back : Point(range * ray));
        van.push_back(is_van);
    }
};

/// Shares of the van and of the rest that are called dynamic in the last of some scans at 5 Hz. The
/// sensor drives 5 m/s, the van `speed` [m/s].
std::pair<double, double> dynamic_at_once(float speed, std::size_t scans) {
    DynamicFilter filter(preset("default"));
    double van = 0, rest = 0, of_van = 0, of_rest = 0;
    for (std::size_t i = 0; i < scans; ++i) {
        const auto time = 0.2F * static_cast<float>(i);
        const Road road(i, time, 5.0F * time, 12.0F + speed * time);
        const Labels labels = filter.push(road.scan).labels;
        if (i + 1 < scans) continue;
        for (std::size_t p = 0; p < labels.size(); ++p) {
            (road.van[p] ? of_van : of_rest) += 1.0;
            if (labels[p] == Label::dynamic) (road.van[p] ? van : rest) += 1.0;
        }
    }
    return {van / of_van, rest / of_rest};
}

TEST(Objects, WhatDrivesAheadIsKnownByThePlacesThatItLeaves) {
    // Its places are never seen free before it gets there.
    EXPECT_LT(dynamic_at_once(5.0F, 2).first, 0.1);
    const auto [van, rest] = dynamic_at_once(5.0F, 4);
    EXPECT_GT(van, 0.95);
    EXPECT_LT(rest, 0.001);
}

TEST(Objects, WhatIsPassedStaysWhereItIs) {
    for (const std::size_t scans : {2U, 4U, 8U}) {
        const auto [van, rest] = dynamic_at_once(0.0F, scans);
        EXPECT_EQ(van, 0.0) << scans;
        EXPECT_LT(rest, 0.001) << scans;
    }
}

TEST(Objects, SurviveThatVoxelsAreForgotten) {
    Followed whole, cut;
    const auto walk = [](int i) { return -4.0F + 0.3F * static_cast<float>(i); };
    for (int i = 0; i < 2; ++i) {  // not yet known to move
        whole.see({0.2 * i, walk(i)}, true);
        cut.see({0.2 * i, walk(i)}, true);
    }
    cut.instances.keep(cut.grid.keep_within(Point(-3.0F, 3.0F, -1.0F), 5.0F, SIZE_MAX));
    EXPECT_LT(cut.grid.size(), whole.grid.size());
    for (int i = 2; i < 9; ++i) {
        whole.see({0.2 * i, walk(i)}, true);
        cut.see({0.2 * i, walk(i)}, true);
    }
    const auto moved = [](const Followed& f) {
        std::vector<std::pair<VoxelKey, int>> all;
        for (std::uint32_t v = 0; v < f.grid.size(); ++v) {
            if (f.grid[v].evidence.moved == 0) continue;
            all.emplace_back(f.grid.voxels().key(v), f.grid[v].evidence.moved);
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    EXPECT_GT(moved(whole).size(), 100U);
    EXPECT_EQ(moved(cut), moved(whole));
}

/// Share of the points that are dynamic.
double dynamic_share(const Followed& f, const std::vector<bool>& of) {
    return static_cast<double>(dynamic_points(f, of)) /
           static_cast<double>(std::count(of.begin(), of.end(), true));
}

TEST(Objects, AScanThatFollowsTooSoonIsLeftAsItIs) {
    Followed f;
    for (int i = 0; i < 8; ++i) f.see({0.2 * i, -4.0F + 0.3F * static_cast<float>(i)}, true);
    const Glance too_soon(1.43, -1.9F), in_time(1.6, -1.9F);
    f.see(too_soon, false);
    EXPECT_EQ(dynamic_points(f, too_soon.person), 0);
    f.see(in_time, false);
    EXPECT_GT(dynamic_share(f, in_time.person), 0.8);
}

TEST(Objects, AFewDynamicVoxelsDoNotMakeATrackMove) {
    Followed f;
    for (int i = 0; i < 30; ++i) {
        Glance sight(0.2 * i);
        const float x = -4.0F + 0.2F * static_cast<float>(i);
        sight.add_box({x, 3.05F, -1.5F}, {x + 0.5F, 3.45F, -0.5F}, sight.bench);
        sight.add_box({x, 3.05F, -0.4F}, {x + 0.5F, 3.45F, -0.1F}, sight.person);  // its head
        f.see(sight, true);
        EXPECT_EQ(dynamic_points(f, sight.bench), 0) << i;
    }
}

/// A van that drives by the steps [m], one every 0.2 s, and stands after the last of them.
Glance van(int scan, const std::vector<float>& steps) {
    float x = -6.0F;
    for (int i = 0; i < scan && i < static_cast<int>(steps.size()); ++i) {
        x += steps[static_cast<std::size_t>(i)];
    }
    Glance sight(0.2 * scan);
    sight.add_box({x, 3.0F, -1.8F}, {x + 3.5F, 4.6F, -0.2F}, sight.person);
    return sight;
}

// It goes farther in a scan than a center may jump; only its speed tells where to expect it. Then
// it stops at once, and only its last place fits.
TEST(Objects, AVanIsFollowedAsItSpeedsUpAndAsItStops) {
    const std::vector<float> steps{0.5F, 0.7F, 0.9F, 1.1F, 1.2F, 1.2F, 1.2F, 1.2F};
    Followed f;
    for (int i = 0; i <= 8; ++i) f.see(van(i, steps), true);
    for (int i = 9; i < 30; ++i) f.see(van(i, steps), false);
    EXPECT_GT(dynamic_share(f, van(29, steps).person), 0.8);
}

// Without the first steps there is no speed, and each scan begins a track of its own.
TEST(Objects, WhatJumpsIsNotFollowed) {
    const std::vector<float> steps(6, 1.2F);
    Followed f;
    for (int i = 0; i <= 6; ++i) f.see(van(i, steps), true);
    for (int i = 7; i < 20; ++i) f.see(van(i, steps), false);
    EXPECT_EQ(dynamic_share(f, van(19, steps).person), 0.0);
}

/// Something of 3 voxels, or of 12, with a point in the middle of each.
Glance few_voxels(double stamp, int step, bool is_large) {
    Glance sight(stamp);
    for (const int x : {0, 1, 2}) {
        for (const int y : {0, 1}) {
            for (const int z : {0, 1}) {
                if (!is_large && (y == 1 || z == 1)) continue;
                const Cell cell(step - 20 + x, 10 + y, z - 5);
                const Point p = (cell.cast<float>().array() + 0.5F) * 0.2F;
                sight.add_box(p, p, sight.person);
            }
        }
    }
    return sight;
}

TEST(Objects, SmallObjectsMayChangeTheirSizeByTheToleranceToo) {
    Followed f;
    for (int i = 0; i < 10; ++i) f.see(few_voxels(0.2 * i, i, i % 2 == 0), true);
    for (int i = 10; i < 30; ++i) f.see(few_voxels(0.2 * i, 9, false), false);
    EXPECT_EQ(dynamic_share(f, few_voxels(0, 9, false).person), 1.0);
}

// A bag is left behind where the track was; the person takes the track along.
TEST(Objects, TheClusterThatSharesMostContinuesTheTrack) {
    const auto sight_of = [](int i) {
        Glance sight(0.2 * i);
        const float x = -6.0F + 0.4F * static_cast<float>(std::min(i, 10));
        sight.add_box({x, 3.05F, -1.8F}, {x + 0.5F, 3.45F, -0.1F}, sight.person);
        if (i >= 10) sight.add_box({-2.9F, 3.05F, -1.5F}, {-2.7F, 3.45F, -0.5F}, sight.bench);
        return sight;
    };
    Followed f;
    for (int i = 0; i < 11; ++i) f.see(sight_of(i), true);
    for (int i = 11; i < 30; ++i) f.see(sight_of(i), false);
    EXPECT_GT(dynamic_share(f, sight_of(29).person), 0.8);
    EXPECT_EQ(dynamic_share(f, sight_of(29).bench), 0.0);
}

}  // namespace objects_test
}  // namespace dynamic_filter
