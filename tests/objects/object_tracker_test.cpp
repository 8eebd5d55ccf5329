// SPDX-License-Identifier: MIT
#include "objects/object_tracker.hpp"

#include <gtest/gtest.h>

#include <set>

namespace dynamic_filter::app {
namespace object_tracker_test {

using Places = std::vector<Eigen::Vector3d>;

/// Points on the sides of a box.
void add_box(Places& places, const Eigen::Vector3d& center, const Eigen::Vector3d& size) {
    const double step = 0.1 / std::max(size.x(), size.y());
    for (double x = -0.5; x <= 0.5; x += step) {
        for (double z = -0.5; z <= 0.5; z += 0.25) {
            for (const double y : {-0.5, 0.5}) {
                places.emplace_back(center + Eigen::Vector3d(x, y, z).cwiseProduct(size));
                places.emplace_back(center + Eigen::Vector3d(y, x, z).cwiseProduct(size));
            }
        }
    }
}
const Eigen::Vector3d kPerson{0.5, 0.5, 1.7}, kCar{4.2, 1.8, 1.5};

/// Follows what `at(t)` gives over `scans` scans, `period` seconds apart. Returns the numbers of
/// each scan.
template <class At>
std::vector<std::vector<std::uint32_t>> followed(ObjectTracker& tracker, std::size_t scans,
                                                 double period, const At& at) {
    std::vector<std::vector<std::uint32_t>> numbers;
    for (std::size_t i = 0; i < scans; ++i) {
        const double t = period * static_cast<double>(i);
        numbers.push_back(tracker.follow(at(t), i, t));
    }
    return numbers;
}

std::set<std::uint32_t> set_of(const std::vector<std::uint32_t>& numbers) {
    return {numbers.begin(), numbers.end()};
}

TEST(ObjectTracker, KeepsTheNumbersOfWhoPassEachOther) {
    ObjectTracker tracker;
    std::vector<std::size_t> ends;
    const auto numbers = followed(tracker, 60, 0.1, [&](double t) {
        Places places;
        ends.clear();
        add_box(places, {1.4 * t, 0.0, 0.9}, kPerson);
        ends.push_back(places.size());
        add_box(places, {8.0 - 1.4 * t, 0.75, 0.9}, kPerson);  // less than a cell aside
        ends.push_back(places.size());
        add_box(places, {20.0 + 12.0 * t, 5.0, 0.9}, kCar);
        ends.push_back(places.size());
        return places;
    });
    for (const auto& scan : numbers) {
        std::size_t begin = 0;
        for (std::size_t object = 0; object < ends.size(); ++object) {
            std::size_t own = 0;
            for (std::size_t i = begin; i < ends[object]; ++i) own += scan[i] == object;
            EXPECT_GE(own, (ends[object] - begin) * 9 / 10);
            begin = ends[object];
        }
    }
    EXPECT_EQ(tracker.objects().size(), 3U);
    EXPECT_NEAR(tracker.objects()[2].velocity.x(), 12.0, 0.1);
    EXPECT_NEAR(tracker.objects()[1].velocity.x(), -1.4, 0.1);
}

TEST(ObjectTracker, GoesOnAfterAShortAbsence) {
    ObjectTracker tracker;
    const auto numbers = followed(tracker, 40, 0.1, [](double t) {
        Places places;
        const bool is_hidden = t > 1.45 && t < 2.95;
        if (!is_hidden) add_box(places, {1.4 * t, 0.0, 0.9}, kPerson);
        return places;
    });
    EXPECT_EQ(set_of(numbers.back()), std::set<std::uint32_t>{0});
    EXPECT_EQ(tracker.objects().size(), 1U);
}

TEST(ObjectTracker, EndsAfterALongAbsence) {
    ObjectTracker tracker;
    followed(tracker, 10, 0.1, [](double t) {
        Places places;
        add_box(places, {1.4 * t, 0.0, 0.9}, kPerson);
        return places;
    });
    EXPECT_TRUE(tracker.may_go_on(0));
    tracker.follow({}, 10, 3.0);
    EXPECT_FALSE(tracker.may_go_on(0));
    Places places;
    add_box(places, {4.0, 0.0, 0.9}, kPerson);
    EXPECT_EQ(set_of(tracker.follow(places, 11, 3.1)), std::set<std::uint32_t>{1});
}

TEST(ObjectTracker, TheSidesOfAVehicleAreOne) {
    ObjectTracker tracker;
    const auto numbers = followed(tracker, 20, 0.1, [](double t) {
        Places places;
        add_box(places, {5.0 * t, 0.0, 1.0}, {9.0, 0.1, 2.0});
        add_box(places, {5.0 * t, 2.4, 1.0}, {9.0, 0.1, 2.0});  // seen through the windows
        return places;
    });
    EXPECT_EQ(set_of(numbers.front()).size(), 2U);
    EXPECT_EQ(set_of(numbers.back()), std::set<std::uint32_t>{0});
}

TEST(ObjectTracker, CarsInARowAreNotOne) {
    ObjectTracker tracker;
    const auto numbers = followed(tracker, 30, 0.1, [](double t) {
        Places places;
        add_box(places, {5.0 * t, 0.0, 1.0}, kCar);
        add_box(places, {5.0 * t + 6.5, 0.0, 1.0}, kCar);
        add_box(places, {5.0 * t, 4.0, 1.0}, kCar);
        return places;
    });
    EXPECT_EQ(set_of(numbers.back()).size(), 3U);
}

TEST(ObjectTracker, AStrayEchoIsNoObject) {
    ObjectTracker tracker;
    const Places few(4, Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(set_of(tracker.follow(few, 0, 0.0)), std::set<std::uint32_t>{kNoObject});
    const Places more(6, Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(set_of(tracker.follow(more, 1, 0.1)), std::set<std::uint32_t>{0});
    EXPECT_FALSE(tracker.objects()[0].is_sure());
}

}  // namespace object_tracker_test
}  // namespace dynamic_filter::app
