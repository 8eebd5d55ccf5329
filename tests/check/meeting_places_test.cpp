// SPDX-License-Identifier: MIT
#include "check/meeting_places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dynamic_filter::io {
namespace meeting_places_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A position for each metre along x.
Positions line(double from, double to, double y, double z = 0.0) {
    Positions positions;
    for (double x = from; x <= to; x += 1.0) positions.emplace_back(x, y, z);
    return positions;
}

double flat(const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return (p - q).head<2>().norm(); }

TEST(MeetingPlaces, AreSpreadOverTheCommonPart) {
    const Positions a = line(0, 1000, 0), b = line(600, 2000, 3);
    const Meeting meeting = find_meeting(a, b, 8);
    ASSERT_EQ(meeting.places.size(), 8U);
    EXPECT_DOUBLE_EQ(meeting.gap, 3.0);
    EXPECT_NEAR(static_cast<double>(meeting.passes), 204.0, 6.0);
    double least = 1e9, most = 0.0;
    for (std::size_t i = 0; i < 8; ++i) {
        const auto& place = meeting.places[i];
        EXPECT_LE(flat(a[place.in_a], b[place.in_b]), kMeetingDistance);
        least = std::min(least, b[place.in_b].x());
        most = std::max(most, b[place.in_b].x());
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_GT(flat(b[place.in_b], b[meeting.places[j].in_b]), 40.0);
        }
    }
    EXPECT_LT(least, 605.0);
    EXPECT_GT(most, 995.0);
}

TEST(MeetingPlaces, LieWithinTenMetres) {
    EXPECT_EQ(find_meeting(line(0, 20, 0), line(0, 20, 10.0), 8).places.size(), 5U);
    const Meeting none = find_meeting(line(0, 20, 0), line(0, 20, 10.1), 8);
    EXPECT_TRUE(none.places.empty());
    EXPECT_EQ(none.passes, 0U);
    EXPECT_NEAR(none.gap, 10.1, 1e-9);
}

TEST(MeetingPlaces, OfPlacesAboveEachOtherTheNearestInHeightCounts) {
    Positions a = line(0, 50, 0, 0.0);
    const Positions above = line(0, 50, 1, 6.0);
    const std::size_t below = a.size();
    a.insert(a.end(), above.begin(), above.end());
    for (const auto& place : find_meeting(a, line(0, 50, 0, 5.0), 8).places) {
        EXPECT_GE(place.in_a, below);
    }
}

TEST(MeetingPlaces, AreFoundWithAnotherHeightAndFarFromTheOrigin) {
    Positions a = line(0, 100, 0), b = line(0, 100, 2, 48.0);
    for (auto* drive : {&a, &b}) {
        for (auto& p : *drive) p += Eigen::Vector3d(-5.5e5, 5.9e6, 0.0);
    }
    const Meeting meeting = find_meeting(a, b, 4);
    EXPECT_EQ(meeting.places.size(), 4U);
    EXPECT_NEAR(meeting.gap, 2.0, 1e-6);
}

TEST(MeetingPlaces, TheGapOfDistantDrivesIsNamed) {
    const Meeting meeting = find_meeting(line(0, 5000, 0), line(0, 5000, 4e5), 8);
    EXPECT_TRUE(meeting.places.empty());
    EXPECT_NEAR(meeting.gap, 4e5, 1.0);
    const Meeting absurd = find_meeting(line(0, 50, 0), line(0, 50, 1e300), 8);
    EXPECT_TRUE(absurd.places.empty());
}

TEST(MeetingPlaces, PositionsThatAreNotKnownArePassedOver) {
    Positions a = line(0, 20, 0);
    a[3].x() = kNan;
    Positions lost(10, Eigen::Vector3d::Constant(kNan));
    EXPECT_FALSE(std::isfinite(find_meeting(a, lost, 8).gap));
    EXPECT_FALSE(std::isfinite(find_meeting({}, a, 8).gap));
    for (const auto& place : find_meeting(a, a, 8).places) EXPECT_NE(place.in_a, 3U);
}

TEST(MeetingPlaces, ScansAroundAPlaceAreAStepApart) {
    Positions way = line(0, 40, 0);
    EXPECT_EQ(scans_around(way, 20, 4.0, 2), (std::vector<std::size_t>{12, 16, 20, 24, 28}));
    EXPECT_EQ(scans_around(way, 0, 4.0, 2), (std::vector<std::size_t>{0, 4, 8}));
    EXPECT_EQ(scans_around(way, 40, 3.0, 1), (std::vector<std::size_t>{37, 40}));
    way[24].x() = kNan;
    EXPECT_EQ(scans_around(way, 20, 4.0, 1), (std::vector<std::size_t>{16, 20, 25}));
    EXPECT_EQ(scans_around(Positions(50, Eigen::Vector3d::Zero()), 7, 4.0, 2),
              (std::vector<std::size_t>{7}));
}

TEST(MeetingPlaces, PositionsOfADriveAreThoseOfItsPoses) {
    Info info;
    info.scan_files.resize(2);
    info.T_world_sensor.assign(2, Pose(Eigen::Translation3d(1, 2, 3)));
    const Recording drive(info);
    EXPECT_EQ(positions_of(drive)[1], Eigen::Vector3d(1, 2, 3));
    EXPECT_FALSE(positions_of(without_poses(drive))[0].allFinite());
}

}  // namespace meeting_places_test
}  // namespace dynamic_filter::io
