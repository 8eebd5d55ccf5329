// SPDX-License-Identifier: MIT
// Scans that are hardly any, scenes that are none, and poses that are not quite right.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/outcome.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace odd_scans_test {

using test::Box;
using test::drive;
using test::RoomScan;
using test::share;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class OddScans : public testing::TestWithParam<const char*> {
protected:
    static std::vector<Verdict> final_verdicts(const std::vector<RoomScan>& scans) {
        return test::run(scans, preset(GetParam())).final;
    }
    /// One verdict a point, and no probability that is none.
    static void expect_whole(const std::vector<RoomScan>& scans) {
        const auto verdicts = final_verdicts(scans);
        ASSERT_EQ(verdicts.size(), scans.size());
        for (std::size_t s = 0; s < scans.size(); ++s) {
            EXPECT_EQ(verdicts[s].labels.size(), scans[s].scan.points.size()) << s;
            for (const float p : verdicts[s].probability) EXPECT_TRUE(p >= 0.0F && p <= 1.0F) << p;
        }
    }
    /// The same points seen every half a second from the same place.
    static std::vector<RoomScan> standing(const Points& points, std::size_t count) {
        std::vector<RoomScan> scans(count);
        for (std::size_t i = 0; i < count; ++i) {
            scans[i].scan.points = points;
            scans[i].scan.stamp = 0.5 * static_cast<double>(i);
            scans[i].scan.index = i;
        }
        return scans;
    }
};

TEST_P(OddScans, HardlyAnyPointsOrNoneThatCount) {
    const std::vector<Points> odd = {{},
                                     {{3, 1, 0}},
                                     {{3, 1, 0}, {5, 2, 1}},
                                     Points(50, {kNan, kNan, kNan}),
                                     Points(50, Point::Zero()),
                                     Points(50, {4, 3, 1})};
    for (const Points& points : odd) expect_whole(standing(points, 20));
    auto scans = drive(24, true);
    for (std::size_t i = 0; i < odd.size(); ++i) scans[3 * i].scan.points = odd[i];
    expect_whole(scans);
}

TEST_P(OddScans, AMillionPointsOnOneSpot) { expect_whole(standing(Points(1000000, {4, 3, 1}), 3)); }

/// Nothing is where it was half a second ago.
TEST_P(OddScans, EverythingMoves) {
    test::Random random(1);
    auto scans = standing({}, 8);
    for (RoomScan& s : scans) s.scan.points = random.points(2000, 20.0);
    expect_whole(scans);
}

/// A hall in which a box of a car's size stands for some of the scans.
std::vector<RoomScan> with_car(std::size_t count, std::size_t leaves) {
    auto scans = drive(count, false);
    const Box room{{-6.03, -5.03, 0.02}, {9.03, 5.03, 3.1}};
    const Box car{{3.0, 1.5, 0.02}, {6.0, 3.0, 1.5}};
    for (std::size_t i = 0; i < leaves; ++i) {
        auto seen = test::scan_room(scans[i].scan.T_world_sensor, room, {car});
        scans[i].scan.points = std::move(seen.scan.points);
        scans[i].truth = std::move(seen.truth);
    }
    return scans;
}

TEST_P(OddScans, AParkedCarIsDynamicOnceItHasLeft) {
    const auto leaves = with_car(40, 16);
    EXPECT_GT(share(leaves, final_verdicts(leaves), Label::dynamic, Label::dynamic), 0.5);
    EXPECT_GT(share(leaves, final_verdicts(leaves), Label::static_, Label::static_), 0.9);
    const auto stays = with_car(40, 40);
    EXPECT_GT(share(stays, final_verdicts(stays), Label::dynamic, Label::static_), 0.9);
}

double gaussian(test::Random& random) {
    const double u = 1.0 - random.uniform(0.0, 1.0), v = random.uniform(0.0, 2.0 * M_PI);
    return std::sqrt(-2.0 * std::log(u)) * std::cos(v);
}

/// 5 cm and 0.5 degrees on each axis.
TEST_P(OddScans, NoiseOfThePosesCostsSomeOfItOnly) {
    test::Random random(3);
    auto scans = drive(24, true);
    for (RoomScan& s : scans) {
        for (int axis = 0; axis < 3; ++axis) {
            Pose& pose = s.scan.T_world_sensor;
            pose.translation()[axis] += 0.05 * gaussian(random);
            pose.rotate(Eigen::AngleAxisd(0.5 * M_PI / 180.0 * gaussian(random),
                                          Eigen::Vector3d::Unit(axis)));
        }
    }
    const auto verdicts = final_verdicts(scans);
    EXPECT_GT(share(scans, verdicts, Label::static_, Label::static_), 0.9);
    EXPECT_GT(share(scans, verdicts, Label::dynamic, Label::dynamic), 0.7);
}

INSTANTIATE_TEST_SUITE_P(Presets, OddScans, testing::Values("default", "paper"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace odd_scans_test
}  // namespace dynamic_filter
