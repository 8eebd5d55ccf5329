// SPDX-License-Identifier: MIT
#include "upkeep/changes.hpp"

#include <gtest/gtest.h>

#include <span>

namespace dynamic_filter::app {
namespace changes_test {

/// A sensor 100 km from the world's origin, in front of boxes of points.
struct Place {
    io::FullScan scan;
    Labels alone, together;

    explicit Place(double stamp) {
        for (const char* name : {"x", "y", "z", "intensity"}) {
            io::add_field(scan.cloud, name, io::FieldType::f32);
        }
        scan.T_world_sensor = Eigen::Translation3d(100000.0, 0.0, 0.0);
        scan.stamp = stamp;
    }
    void add_box(const Point& corner, int side, Label is_alone, Label is_together) {
        for (int x = 0; x < side; ++x) {
            for (int y = 0; y < side; ++y) {
                const Point p =
                    corner + 0.1F * Point(static_cast<float>(x), static_cast<float>(y), 0.0F);
                const std::array<float, 4> record = {p.x(), p.y(), p.z(), 7.0F};
                const auto bytes = std::as_bytes(std::span(record));
                scan.cloud.data.insert(scan.cloud.data.end(), bytes.begin(), bytes.end());
                scan.points.push_back(p);
                alone.push_back(is_alone);
                together.push_back(is_together);
            }
        }
    }
};

constexpr Label kRests = Label::static_, kAway = Label::dynamic;

ChangedPoints seen_in(int scans) {
    ChangedPoints points;
    for (int i = 0; i < scans; ++i) {
        Place place(10.0 + i);
        place.add_box({5.0F, 0.0F, 0.0F}, 8, kRests, kAway);
        place.add_box({5.0F, 9.0F, 0.0F}, 12, kRests, kAway);
        place.add_box({9.0F, 0.0F, 0.0F}, 9, kRests, kRests);  // is still there
        place.add_box({9.0F, 9.0F, 0.0F}, 9, kAway, kAway);    // moves itself
        place.add_box({0.0F, 9.0F, 0.0F}, 2, kRests, kAway);   // a speck
        points.add(place.scan, place.alone, place.together);
    }
    return points;
}

TEST(ChangedPoints, AreWhatRestedAndIsSeenThrough) {
    const ChangedPoints points = seen_in(4);
    const std::vector<Change> changes = points.changes({});
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].points(), 4U * 144U);
    EXPECT_EQ(changes[1].points(), 4U * 64U);
    EXPECT_EQ(changes[1].scans, 4U);
    EXPECT_EQ(changes[1].first, 10.0);
    EXPECT_EQ(changes[1].last, 13.0);
    EXPECT_NEAR(changes[1].box.min().x(), 100005.0, 0.01);
    EXPECT_NEAR(changes[1].box.sizes().y(), 0.7, 0.01);

    const io::Cloud cloud = points.cloud(changes);
    ASSERT_EQ(cloud.size(), 4U * 208U);
    EXPECT_EQ(io::values(cloud, *cloud.find("change")).back(), 2.0);
    EXPECT_EQ(io::values(cloud, *cloud.find("intensity")).front(), 7.0);
    EXPECT_EQ(cloud.find("x")->type, io::FieldType::f64) << "far from the origin";
}

TEST(ChangedPoints, AreNotWhatRestsAtTheOtherDateToo) {
    ChangedPoints other;
    Place place(99.0);
    place.add_box({5.0F, 9.0F, 0.0F}, 12, kRests, kRests);
    other.add(place.scan, place.alone, place.together);
    const std::vector<Change> changes = seen_in(4).changes(other);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].points(), 4U * 64U);

    for (int i = 0; i < 12; ++i) {  // called dynamic wrongly: nothing passes for so long
        Place again(100.0 + i);
        again.add_box({5.0F, 0.0F, 0.0F}, 8, kAway, kAway);
        other.add(again.scan, again.alone, again.together);
        EXPECT_EQ(seen_in(4).changes(other).size(), i < 9 ? 1U : 0U);
    }
}

TEST(ChangedPoints, OfAMomentAreNone) {
    EXPECT_TRUE(seen_in(2).changes({}).empty());
    EXPECT_EQ(seen_in(2).cloud({}).size(), 0U);
    EXPECT_EQ(ChangedPoints().cloud({}).size(), 0U);
}

}  // namespace changes_test
}  // namespace dynamic_filter::app
