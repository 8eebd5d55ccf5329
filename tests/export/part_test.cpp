// SPDX-License-Identifier: MIT
#include "export/part.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "export/places.hpp"
#include "support/bytes.hpp"
#include "support/random.hpp"

namespace dynamic_filter::app {
namespace part_test {

io::Cloud cloud_of(const Points& points) {
    io::Cloud cloud;
    for (const char* name : {"x", "y", "z"}) io::add_field(cloud, name, io::FieldType::f32);
    const auto bytes = std::as_bytes(std::span(points));
    cloud.data.assign(bytes.begin(), bytes.end());
    return cloud;
}

io::FullScan sample_scan() {
    test::Random random(2);
    io::FullScan scan;
    scan.points = random.points(500, 15.0);
    scan.points[7] = Point::Zero();  // no measurement
    scan.cloud = cloud_of(scan.points);
    scan.T_world_sensor = random.pose(3.0, 2.0);
    scan.stamp = 3.5;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        constexpr std::array kLabels = {Label::unknown, Label::static_, Label::dynamic};
        scan.truth.push_back(kLabels[random.below(kLabels.size())]);
        scan.times.push_back(random.uniform_f(0.0, 0.1));
    }
    return scan;
}

TEST(Part, ReadsBoxes) {
    EXPECT_FALSE(box_of("").has_value());
    const Box box = *box_of("3,-2,1,-3,2,-1.5");
    EXPECT_EQ(box.min(), Eigen::Vector3d(-3, -2, -1.5));
    EXPECT_EQ(box.max(), Eigen::Vector3d(3, 2, 1));
    const Box column = *box_of("0, 0, 1, 1");
    EXPECT_TRUE(column.contains(Eigen::Vector3d(0.5, 0.5, 1e6)));
    EXPECT_TRUE(column.contains(Eigen::Vector3d(0.5, 0.5, -1e6)));
    EXPECT_FALSE(column.contains(Eigen::Vector3d(0.5, 1.5, 0)));
    for (const char* text : {"1", "1,2,3", "1,2,3,4,5", "1,2,3,4,5,x", "nan,0,1,1", "0,0,inf,1"}) {
        EXPECT_HAS(io::error_of<ConfigError>([&] { box_of(text); }), "two corners");
    }
}

TEST(Part, TakesWhatIsWithinBoxAndRange) {
    const io::FullScan scan = sample_scan();
    Wanted part{box_of("-10,-10,-5,15,12,9"), 12.0};
    const auto wanted = wanted_points(part, scan, {});
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
        const Eigen::Vector3d at = scan.T_world_sensor * scan.points[i].cast<double>();
        const bool is_in = at.x() >= -10 && at.x() <= 15 && at.y() >= -10 && at.y() <= 12 &&
                           at.z() >= -5 && at.z() <= 9;
        if (is_in && scan.points[i].norm() <= 12.0F && i != 7) expected.push_back(i);
    }
    EXPECT_EQ(wanted, expected);
    EXPECT_GT(wanted.size(), 20U);
    part.sensor = {0.0, 0.0, 100.0};
    EXPECT_TRUE(wanted_points(part, scan, {}).empty()) << "the range is that from the sensor";
}

TEST(Part, TakesAllUnlessAskedFor) {
    const io::FullScan scan = sample_scan();
    EXPECT_TRUE(Wanted{}.takes_all());
    EXPECT_EQ(wanted_points({}, scan, {}).size(), scan.points.size());
}

TEST(Part, TakesWhatStandsOrWhatMoves) {
    const io::FullScan scan = sample_scan();
    const auto count = [&](Kept only, bool keep_unknown) {
        Wanted part;
        part.only = only;
        part.keep_unknown = keep_unknown;
        return wanted_points(part, scan, scan.truth).size();
    };
    const auto of = [&](Label label) {
        std::size_t n = 0;
        for (std::size_t i = 0; i < scan.truth.size(); ++i) n += i != 7 && scan.truth[i] == label;
        return n;
    };
    EXPECT_EQ(count(Kept::removed, true), of(Label::dynamic));
    EXPECT_EQ(count(Kept::in_map, true), of(Label::static_) + of(Label::unknown));
    EXPECT_EQ(count(Kept::in_map, false), of(Label::static_));
}

TEST(Part, PartOfAScanHasAllThatBelongsToItsPoints) {
    const io::FullScan scan = sample_scan();
    const std::vector<std::uint32_t> points = {3, 4, 99};
    const io::FullScan part = part_of(scan, points);
    EXPECT_EQ(part.points, (Points{scan.points[3], scan.points[4], scan.points[99]}));
    EXPECT_EQ(io::positions(part.cloud), part.points);
    EXPECT_EQ(part.truth, (Labels{scan.truth[3], scan.truth[4], scan.truth[99]}));
    EXPECT_EQ(part.times, (std::vector<float>{scan.times[3], scan.times[4], scan.times[99]}));
    EXPECT_EQ(part.stamp, scan.stamp);
    EXPECT_TRUE(part.T_world_sensor.isApprox(scan.T_world_sensor));
    EXPECT_TRUE(part.own.empty());
}

TEST(Part, OfACloud) {
    io::Cloud cloud = cloud_of({{0, 0, 0}, {5, 0, 0}, {0, 0, 5}});
    cloud.crs = "a system";
    const auto wanted = wanted_points(*box_of("-1,-1,1,1"), cloud);
    EXPECT_EQ(wanted, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(part_of(cloud, wanted).crs, "a system");
}

TEST(Part, ThinnedCloudsKeepThePointNearestToTheMiddle) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const io::Cloud cloud =
        cloud_of({{0.1F, 0.1F, 0.1F}, {0.4F, 0.5F, 0.6F}, {1.5F, 0, 0}, {nan, 0, 0}});
    const Points kept = io::positions(thinned(cloud, 1.0).cloud);
    EXPECT_EQ(thinned(cloud, 1.0).left_out, 1U);
    EXPECT_EQ(kept, (Points{{0.4F, 0.5F, 0.6F}, {1.5F, 0, 0}}));
}

}  // namespace part_test
}  // namespace dynamic_filter::app
