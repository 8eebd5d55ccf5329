// SPDX-License-Identifier: MIT
#include "filter/label.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "filter/evidence_map.hpp"
#include "filter/vote.hpp"
#include "support/filled_map.hpp"

namespace dynamic_filter {
namespace label_test {

using test::every_scan;

TEST(InstantLabels, AskedWithoutReserveAreThoseOfTheEvidenceSoFar) {
    Config config = every_scan();
    config.scans.vote.ask_again = -1.0;  // whatever the score: every voxel is judged anew
    EvidenceMap map(config);
    InstantLabels instant(config);
    StageTimes times;
    int known = 0;
    for (const auto& s : test::drive(8, true)) {
        const PointVoxels voxels = map.insert(s.scan, times);
        const Verdict verdict = instant.label(s.scan.index, voxels, map.grid());
        EXPECT_EQ(verdict.index, s.scan.index);
        ASSERT_EQ(verdict.probability.size(), voxels.size());
        for (std::size_t i = 0; i < voxels.size(); i += 17) {
            const auto occupancy = occupancy_of(map.grid(), {&voxels[i], 1}, config.scans);
            EXPECT_EQ(verdict.labels[i], label_of(occupancy[0], config.map.occupancy_threshold));
            EXPECT_NEAR(verdict.probability[i], occupancy[0].value_or(0.0F), 0.5F / 255.0F + 1e-6F);
            known += occupancy[0] ? 1 : 0;
        }
        map.observe_elsewhere(times);
    }
    EXPECT_GT(known, 100);
}

TEST(InstantLabels, AreRememberedByTheNewNumbersOfVoxels) {
    const Config config = every_scan();
    EvidenceMap map(config);
    InstantLabels instant(config);
    StageTimes times;
    const auto scans = test::drive(8, true);
    PointVoxels voxels;
    Verdict before;
    for (const auto& s : scans) {
        voxels = map.insert(s.scan, times);
        before = instant.label(s.scan.index, voxels, map.grid());
        map.observe_elsewhere(times);
    }
    instant.keep(map.keep_within(Point(0.0F, 0.0F, 1.0F), 100.0F, SIZE_MAX));
    const Verdict after = instant.label(9, voxels, map.grid());
    EXPECT_EQ(after.labels.size(), before.labels.size());
}

const Config config;
constexpr float kSize = 0.2F;

Point middle(int x, int y, int z) { return (Cell(x, y, z).cast<float>().array() + 0.5F) * kSize; }

/// A grid of one or more scans, each given by its points in the map frame.
struct Map {
    EvidenceGrid grid{kSize, config.scans.evidence};

    /// Returns the voxels of the points.
    PointVoxels add(const Points& points) {
        Scan scan;
        scan.points = points;
        return grid.add_points(scan);
    }
    void see(std::uint32_t voxel, Sight sight, int times = 1) {
        for (int i = 0; i < times; ++i) grid.record(voxel, sight, 1, true);
        grid.update_score(voxel);
    }
    [[nodiscard]] LocatedScan locate(const Points& points) const {
        LocatedScan scan;
        to_voxels(points, kSize, scan.in_map);
        for (const VoxelKey key : scan.in_map.keys) {
            scan.voxels.push_back(grid.voxels().find(key).value_or(kNoVoxel));
        }
        return scan;
    }
};

Verdict decide(const Map& map, const VoxelDecisions& decided, const Points& points) {
    Verdict verdict{0, Labels(points.size(), Label::unknown),
                    std::vector<float>(points.size(), -1.0F)};
    decide_points(map.locate(points), decided, map.grid, config, verdict);
    return verdict;
}

/// The decision on a map of one voxel.
VoxelDecisions one(Label label, float probability) {
    VoxelDecisions decided;
    decided.voxels.push_back({label, false});
    decided.probability.push_back(probability);
    return decided;
}

/// Ground of 7 x 7 voxels at z = 0.1, and a leg that stands on the one in its middle.
struct Street {
    Map map;
    PointVoxels ground, leg;

    Street() {
        Points points;
        for (int x = -3; x <= 3; ++x) {
            for (int y = -3; y <= 3; ++y) points.push_back(middle(x, y, 0));
        }
        for (int z = 1; z <= 5; ++z) points.push_back(middle(0, 0, z));
        PointVoxels voxels = map.add(points);
        leg.assign(voxels.begin() + 49, voxels.end());
        ground.assign(voxels.begin(), voxels.begin() + 49);
        for (const std::uint32_t v : ground) map.see(v, Sight::occupied, 40);
        for (const std::uint32_t v : leg) map.see(v, Sight::passed, 40);
    }
};

TEST(InstantLabels, AFootIsDynamicDownToTheGroundWhileTheLegIsThere) {
    const Street street;
    const std::uint32_t under = street.ground[24], away = street.ground[45];  // three voxels away
    const auto height = static_cast<float>(config.scans.contact.height);
    const Point foot(0.1F, 0.1F, 0.1F + height + 0.005F);
    const auto label = [&](const Point& p, std::uint32_t voxel, bool with_leg) {
        Scan scan{{p}, Pose::Identity(), 0.0, 0, true, {}};
        PointVoxels voxels{voxel};
        for (const std::uint32_t v : street.ground) voxels.push_back(v);
        if (with_leg) voxels.insert(voxels.end(), street.leg.begin(), street.leg.end());
        for (std::size_t i = 1; i < voxels.size(); ++i) {
            scan.points.push_back(street.map.grid[voxels[i]].centroid);
        }
        InstantLabels instant(config);
        Labels labels = instant.label(0, voxels, street.map.grid).labels;
        instant.find_contacts(scan, voxels, street.map.grid, config.scans.contact, labels);
        return labels[0];
    };
    EXPECT_EQ(label(foot, under, true), Label::dynamic);
    EXPECT_EQ(label(foot - Point(0.0F, 0.0F, 0.01F), under, true), Label::static_);
    EXPECT_EQ(label(foot + Point(0.6F, 0.0F, 0.0F), away, true), Label::static_);
    EXPECT_EQ(label(foot, under, false), Label::static_);
}

TEST(DecideVoxels, GroundIsStaticTheLegIsDynamicAndTheyMeetAtASurface) {
    const Street street;
    const auto decided = decide_voxels(street.map.grid, config);
    ASSERT_EQ(decided.voxels.size(), 54U);
    for (std::size_t i = 0; i < street.ground.size(); ++i) {
        const std::uint32_t v = street.ground[i];
        const int x = static_cast<int>(i) / 7 - 3, y = static_cast<int>(i) % 7 - 3;
        EXPECT_EQ(decided.voxels[v].label, Label::static_);
        EXPECT_GT(decided.occupancy(v).value(), 0.5F);
        // Only the leg's lowest voxel and those beside it touch the leg.
        const bool has_contact = decided.voxels[v].has_contact;
        EXPECT_EQ(has_contact, std::max(std::abs(x), std::abs(y)) <= 1) << x << ' ' << y;
        EXPECT_EQ(has_contact, decided.contacts.contains(v));
        if (!has_contact) continue;
        const ContactSurface& contact = decided.contacts.at(v);
        EXPECT_NEAR(contact.height({0.3F, -0.2F, 0.1F + 0.07F}), 0.07F, 1e-3);
        EXPECT_NEAR(contact.roughness, 0.0F, 1e-3);
    }
    for (const std::uint32_t v : street.leg) {
        EXPECT_EQ(decided.voxels[v].label, Label::dynamic);
        EXPECT_LT(decided.occupancy(v).value(), 0.5F);
        EXPECT_FALSE(decided.voxels[v].has_contact);
    }
}

TEST(DecideVoxels, AVoxelThatNobodyObservedIsUnknown) {
    Map map;
    map.add({middle(0, 0, 0), middle(50, 0, 0)});
    map.see(0, Sight::occupied, 10);
    const auto decided = decide_voxels(map.grid, config);
    EXPECT_TRUE(decided.occupancy(0));
    EXPECT_FALSE(decided.occupancy(1));
}

TEST(DecidePoints, AFootIsDynamicOnlyAboveTheSurfaceAndOnlyWhileTheLegIsThere) {
    const Street street;
    const auto decided = decide_voxels(street.map.grid, config);
    const auto height = static_cast<float>(config.scans.contact.height);
    const Point leg = middle(0, 0, 1);
    const Points points{leg,
                        {0.1F, 0.1F, 0.1F + height + 0.005F},  // the foot
                        {0.1F, 0.1F, 0.1F + height - 0.005F},  // the ground under it
                        {0.7F, 0.1F, 0.1F + height + 0.005F},  // three voxels away
                        {9.0F, 9.0F, 9.0F}};                   // in no voxel
    const Verdict with_leg = decide(street.map, decided, points);
    EXPECT_EQ(with_leg.labels, (Labels{Label::dynamic, Label::dynamic, Label::static_,
                                       Label::static_, Label::unknown}));
    EXPECT_LT(with_leg.probability[0], 0.5F);
    EXPECT_GT(with_leg.probability[1], 0.5F);  // that of its voxel
    EXPECT_EQ(with_leg.probability[4], -1.0F);
    const Verdict without = decide(street.map, decided, {points[1], points[2]});
    EXPECT_EQ(without.labels, (Labels{Label::static_, Label::static_}));
}

TEST(DecidePoints, OnARoughSurfaceAPointMustBeHigher) {
    Map map;
    map.add({middle(0, 0, 0), middle(0, 0, 2)});
    const auto roughness = static_cast<float>(config.scans.contact.roughness);
    const ContactSurface rough{Point::UnitZ(), 0.0F, 0.03F};
    VoxelDecisions decided = one(Label::static_, 0.9F);
    decided.voxels.front().has_contact = true;
    decided.contacts[0] = rough;
    decided.voxels.push_back({Label::dynamic, false});
    decided.probability.push_back(0.1F);
    const auto label_at = [&](float height, const Point& leg) {
        return decide(map, decided, {{0.1F, 0.1F, height}, leg}).labels[0];
    };
    const Point leg = middle(0, 0, 2);
    EXPECT_EQ(label_at(roughness * 0.03F + 0.002F, leg), Label::dynamic);  // two cells away
    EXPECT_EQ(label_at(roughness * 0.03F - 0.002F, leg), Label::static_);
    EXPECT_EQ(label_at(0.19F, middle(0, 0, 4)), Label::static_);
}

TEST(DecidePoints, VoxelsThatCameAfterTheDecisionAreLeftOut) {
    Map map;
    map.add({middle(0, 0, 0), middle(5, 0, 0)});
    const Verdict verdict =
        decide(map, one(Label::static_, 0.5F), {middle(0, 0, 0), middle(5, 0, 0)});
    EXPECT_EQ(verdict.labels, (Labels{Label::static_, Label::unknown}));
    const VoxelDecisions unknown = one(Label::unknown, 0.0F);
    EXPECT_EQ(decide(map, unknown, {middle(0, 0, 0)}).probability[0], 0.0F);
}

/// A car that parked: seen through first, then hit by the scans from number `first` to `last`.
Map parked(int first, int last) {
    Map map;
    map.add({middle(0, 0, 0)});
    map.see(0, Sight::passed);
    for (int scan = 1; scan <= last; ++scan) {
        map.add({scan >= first ? middle(0, 0, 0) : middle(50, 0, 0)});
        map.see(0, scan >= first ? Sight::occupied : Sight::passed);
    }
    return map;
}

TEST(OccupiedSince, BeginsWithTheLastRunIfThatIsLongEnough) {
    const int longest = config.scans.evidence.longest_run;
    VoxelDecisions dynamic = one(Label::dynamic, 0.1F);
    dynamic.voxels.push_back({Label::static_, false});
    dynamic.probability.push_back(0.9F);
    const auto since = [&](const Map& map) { return occupied_since(dynamic, map.grid, config)[0]; };
    EXPECT_EQ(since(parked(7, 6 + longest)), 7U);
    EXPECT_EQ(since(parked(7, 90)), 7U);
    EXPECT_FALSE(since(parked(7, 5 + longest)));
    // Keyframes see the place occupied, but too few scans have points in the voxel itself.
    Map beside = parked(7, 5 + longest);
    beside.see(0, Sight::occupied, 5);
    EXPECT_FALSE(since(beside));
    // It has left.
    Map left = parked(7, 90);
    left.see(0, Sight::weak_free);
    EXPECT_FALSE(since(left));
    Map empty = parked(7, 90);
    empty.see(0, Sight::free);
    empty.see(0, Sight::occupied, longest);
    EXPECT_FALSE(since(empty));  // no point since it was seen empty
    // A static voxel was always there, and an unknown one is no object.
    for (const Label label : {Label::static_, Label::unknown}) {
        EXPECT_FALSE(occupied_since(one(label, 0.9F), parked(7, 90).grid, config)[0]);
    }
}

}  // namespace label_test
}  // namespace dynamic_filter
