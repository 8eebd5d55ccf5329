// SPDX-License-Identifier: MIT
#include "filter/mirrors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace dynamic_filter::mirrors_test {

using Eigen::AlignedBox3f;

namespace {

/// What is in the part of the wall y = -6 from x = -3 to 3. Behind `twin` is a room that looks like
/// the first one in a mirror.
enum class Part { wall, mirror, doorway, twin };

const std::vector<AlignedBox3f>& things_before() {
    static const std::vector<AlignedBox3f> things = {
        {Point(-5.0F, -1.0F, 0.0F), Point(-4.4F, -0.4F, 3.0F)},
        {Point(-2.6F, 1.5F, 0.0F), Point(-1.4F, 2.1F, 1.2F)},
        {Point(1.2F, -3.4F, 0.0F), Point(1.8F, -2.6F, 1.4F)},
        {Point(3.4F, 2.4F, 0.0F), Point(4.6F, 3.0F, 2.0F)},
        {Point(-0.8F, -4.4F, 0.0F), Point(0.2F, -4.0F, 0.9F)},
        {Point(0.5F, 3.9F, 0.0F), Point(1.0F, 4.3F, 2.4F)}};
    return things;
}
const std::vector<AlignedBox3f>& things_behind() {
    static const std::vector<AlignedBox3f> things = {
        {Point(-2.2F, -8.2F, 0.0F), Point(-1.5F, -7.7F, 1.6F)},
        {Point(0.6F, -11.0F, 0.0F), Point(1.6F, -10.4F, 1.1F)},
        {Point(3.0F, -9.3F, 0.0F), Point(3.6F, -8.7F, 3.0F)}};
    return things;
}

/// Distance to the box from outside, or to its faces from within.
float until(const AlignedBox3f& box, const Point& from, const Point& way) {
    float enters = -std::numeric_limits<float>::infinity(), leaves = -enters;
    for (int k = 0; k < 3; ++k) {
        const float a = (box.min()[k] - from[k]) / way[k], b = (box.max()[k] - from[k]) / way[k];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
    }
    if (leaves < enters || leaves <= 0.0F) return std::numeric_limits<float>::infinity();
    return enters > 0.0F ? enters : leaves;
}

Point mirrored(const Point& p) { return {p.x(), -12.0F - p.y(), p.z()}; }

/// A person in the first room.
struct Walker {
    std::optional<AlignedBox3f> body{};
    bool has_twin = false;  ///< somebody walks alike behind the doorway of the twin

    /// Who is in the room that is seen in the mirror, or behind the doorway.
    [[nodiscard]] Walker behind(Part part) const {
        return part == Part::mirror || has_twin ? *this : Walker{};
    }
};

float range(Part part, const Walker& walker, const Point& from, const Point& way) {
    if (part == Part::twin && from.y() < -6.0F) {
        return range(part, walker.behind(part), mirrored(from), {way.x(), -way.y(), way.z()});
    }
    const AlignedBox3f before(Point(-10.0F, -6.0F, 0.0F), Point(10.0F, 6.0F, 3.0F));
    const AlignedBox3f behind(Point(-10.0F, -14.0F, 0.0F), Point(10.0F, -6.0F, 3.0F));
    const bool starts_before = from.y() > -6.0F;
    float nearest = until(starts_before ? before : behind, from, way);
    for (const auto& box : starts_before ? things_before() : things_behind()) {
        nearest = std::min(nearest, until(box, from, way));
    }
    if (walker.body && starts_before) nearest = std::min(nearest, until(*walker.body, from, way));
    const Point at = from + nearest * way;
    const bool is_through = starts_before && std::abs(at.y() + 6.0F) < 1e-3F &&
                            std::abs(at.x()) < 3.0F && at.z() > 0.1F && at.z() < 2.6F;
    if (!is_through || part == Part::wall) return nearest;
    Point onward = way;
    const bool looks_mirrored = part != Part::doorway;
    if (looks_mirrored) onward.y() = -onward.y();
    const Point on = at + 0.01F * onward;
    return nearest + 0.01F +
           range(looks_mirrored ? Part::wall : part, walker.behind(part), on, onward);
}

/// Where somebody is who walks along the wall, half way between it and the sensor.
AlignedBox3f walker_in(std::size_t scan) {
    const Point middle(3.5F - 0.6F * static_cast<float>(scan), -2.2F, 0.9F);
    return {middle - Point(0.25F, 0.25F, 0.9F), middle + Point(0.25F, 0.25F, 0.9F)};
}

/// Twelve scans before the wall, then some from behind it.
enum class Walks { nobody, before, on_both_sides };
EvidenceMap seen(Part part, std::size_t behind = 0, Walks walks = Walks::before) {
    EvidenceMap map(Config{});
    StageTimes times;
    for (std::size_t i = 0; i < 12 + behind; ++i) {
        Scan scan;
        scan.index = i;
        scan.stamp = 0.5 * static_cast<double>(i);
        scan.T_world_sensor.setIdentity();
        Point sensor(-4.0F + 0.7F * static_cast<float>(i % 12), 0.3F, 1.3F);
        if (i >= 12) sensor = mirrored(sensor);
        scan.T_world_sensor.translation() = sensor.cast<double>();
        for (int row = -15; row <= 15; ++row) {
            for (int column = 0; column < 360; ++column) {
                const float up = 0.025F * static_cast<float>(row) + 0.003F;
                const float turn = 0.0174533F * (static_cast<float>(column) + 0.37F);
                const Point way(std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn),
                                std::sin(up));
                const Walker walker = walks == Walks::nobody
                                          ? Walker{}
                                          : Walker{walker_in(i), walks == Walks::on_both_sides};
                scan.points.emplace_back(range(part, walker, sensor, way) * way);
            }
        }
        map.insert(scan, times);
        map.observe_elsewhere(times);
    }
    return map;
}

}  // namespace

TEST(Mirrors, AMirrorIsFoundAndSoIsWhatIsSeenInIt) {
    const EvidenceMap map = seen(Part::mirror);
    const auto mirrors = find_mirrors(map, {});
    ASSERT_EQ(mirrors.size(), 1U);
    EXPECT_GT(mirrors[0].plane.normal.y(), 0.999F);
    EXPECT_NEAR(mirrors[0].plane.offset, -6.0F, 0.07F);
    const Point sensor(0.0F, 0.3F, 1.3F);
    int reflected = 0;
    for (int i = 0; i < 100; ++i) {  // few beams leave gaps between the cells that are found
        const float x = -2.0F + 0.04F * static_cast<float>(i);
        reflected += is_reflected(mirrors, sensor, {x, -9.0F, 1.2F}) ? 1 : 0;
    }
    EXPECT_GT(reflected, 25);
    EXPECT_FALSE(is_reflected(mirrors, sensor, {1.0F, -6.1F, 1.2F}));  // on the mirror
    EXPECT_FALSE(is_reflected(mirrors, sensor, {1.0F, 4.0F, 1.2F}));   // in front of it
    EXPECT_FALSE(is_reflected(mirrors, sensor, {9.0F, -9.0F, 1.2F}));  // beside it
    EXPECT_FALSE(is_reflected(mirrors, {0.0F, -8.0F, 1.3F}, {1.0F, -9.0F, 1.2F}));  // from behind
    EXPECT_FALSE(is_on(mirrors, {0.0F, -5.5F, 1.2F}));
    EXPECT_FALSE(is_on(mirrors, {8.0F, -6.0F, 1.2F}));
}

TEST(Mirrors, ADoorwayIntoAnotherRoomIsNone) {
    EXPECT_TRUE(find_mirrors(seen(Part::doorway), {}).empty());
}

TEST(Mirrors, ARoomLikeTheFirstOneIsNoneOnceItWasSeenFromWithin) {
    const auto mirrors = [](std::size_t behind) {
        return find_mirrors(seen(Part::twin, behind, Walks::on_both_sides), {}).size();
    };
    EXPECT_EQ(mirrors(0), 1U);  // nothing tells it from a mirror yet
    EXPECT_EQ(mirrors(6), 0U);
}

TEST(Mirrors, ARoomLikeTheFirstOneIsNoneIfSomebodyWalksInOneOfThem) {
    EXPECT_TRUE(find_mirrors(seen(Part::twin, 0, Walks::before), {}).empty());
}

TEST(Mirrors, FewPlacesAreNoneWhereNothingMoves) {
    EXPECT_TRUE(find_mirrors(seen(Part::twin, 0, Walks::nobody), {}).empty());
    EXPECT_TRUE(find_mirrors(seen(Part::mirror, 0, Walks::nobody), {}).empty());
}

TEST(Mirrors, AClosedWallIsNone) { EXPECT_TRUE(find_mirrors(seen(Part::wall), {}).empty()); }

TEST(Mirrors, NoneAreFoundInAnEmptyMapOrIfTurnedOff) {
    EXPECT_TRUE(find_mirrors(EvidenceMap(Config{}), {}).empty());
    EXPECT_TRUE(find_mirrors(seen(Part::mirror), {.matched = 1.0}).empty());
}

TEST(Mirrors, WhatIsSeenInAMirrorDoesNotCountAgainstWhatIsBehindIt) {
    EvidenceMap map = seen(Part::mirror);
    const auto mirrors = find_mirrors(map, {});
    std::vector<std::uint32_t> reflected;
    for (std::uint32_t v = 0; v < map.grid().size(); ++v) {
        const Evidence& e = map.grid()[v].evidence;
        const Point& sensor = map.sensor_of_owner(e.first_owner);
        if (e.n_occ + e.n_free > 0 && is_reflected(mirrors, sensor, map.grid()[v].centroid))
            reflected.push_back(v);
    }
    ASSERT_GT(reflected.size(), 100U);
    observe_behind(mirrors, map);
    std::size_t observed = 0;
    for (const std::uint32_t v : reflected) {
        const Evidence& e = map.grid()[v].evidence;
        EXPECT_GT(e.n_own, 0U);
        observed += e.n_occ + e.n_free > 0 ? 1 : 0;
    }
    EXPECT_LT(observed, reflected.size() * 3 / 4);
}

}  // namespace dynamic_filter::mirrors_test
