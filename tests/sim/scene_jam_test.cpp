// SPDX-License-Identifier: MIT
#include "sim/jam.hpp"
#include "sim/scene_checks.hpp"
#include "sim/vehicle_checks.hpp"

namespace dynamic_filter::sim::scene_jam_test {

using Eigen::Vector2d;

namespace {

Scene jam_of(std::uint64_t seed, int people = 0) { return entry("jam").make(people, seed); }

/// The longest time for which a walker stands, between 0 and `duration`.
double longest_wait(const Crowd& crowd, std::size_t i, double duration) {
    double longest = 0.0, since = 0.0;
    for (double t = 0.0; t < duration; t += 0.25) {
        if (stride_at(crowd, i, t).speed > 0.2F) since = t;
        longest = std::max(longest, t - since);
    }
    return longest;
}

void expect_no_touch(const std::string& name) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const Scene scene = entry(name).make(0, seed);
        for (double t = 0.0; t < scene.duration; t += 0.2) {
            std::vector<Obstacle> outlines = {outline(VehicleKind::car, scene.robot, t)};
            for (const Vehicle& vehicle : scene.vehicles)
                outlines.push_back(outline(vehicle.kind, vehicle.ride, t));
            for (std::size_t i = 0; i < outlines.size(); ++i) {
                const Obstacle& own = outlines[i];
                for (std::size_t j = 0; j < i; ++j) {
                    ASSERT_GT(clearance(own, outlines[j]), 0.05)
                        << seed << ": " << i << " " << j << " at " << t << " s, "
                        << own.centre.transpose() << ", " << outlines[j].centre.transpose();
                }
                for (const Obstacle& o : scene.obstacles) {
                    if ((o.centre - own.centre).norm() > 12.0 + o.half.norm()) continue;
                    ASSERT_GT(clearance(own, o), 0.0)
                        << seed << ": " << i << " at " << t << " s, " << own.centre.transpose();
                }
            }
        }
    }
}

}  // namespace

TEST(SceneJam, NoVehicleTouchesAnythingAtAnyTime) { expect_no_touch("jam"); }

TEST(SceneJam, WhatIsAVehicleMovesWhatNeverMovesIsNot) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const Scene scene = jam_of(seed);
        for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
            const Ride& ride = scene.vehicles[i].ride;
            EXPECT_GT(travelled(ride, scene.duration) - travelled(ride, 0.0), 3.0)
                << seed << " " << i;
        }
        std::size_t parked = 0;
        for (const Obstacle& o : scene.obstacles)
            parked += std::abs(std::abs(o.centre.y()) - jam::parking) < 0.1;
        EXPECT_GT(parked, 40U);
    }
}

TEST(SceneJam, TheSensorHaltsInTheQueueAndDrivesOn) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const Scene scene = jam_of(seed);
        const auto halts = rests(scene.robot, scene.duration);
        std::size_t queues = 0;
        for (const Rest& rest : halts) {
            EXPECT_LT(rest.until - rest.from, 60.0) << seed;
            queues += rest.until - rest.from > 15.0;
        }
        EXPECT_GE(queues, 2U) << seed;
        EXPECT_GT(travelled(scene.robot, scene.duration) - travelled(scene.robot, 0.0), 250.0);
        const double end = scene.duration;
        EXPECT_GT(travelled(scene.robot, end) - travelled(scene.robot, end - 1.0), 3.0) << seed;
    }
}

TEST(SceneJam, QueuesStandAndTheBusAndTheVanHalt) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const Scene scene = jam_of(seed);
        std::size_t queued = 0, bus = 0, van = 0, arrivals = 0, departures = 0, cyclists = 0;
        for (const Vehicle& vehicle : scene.vehicles) {
            for (const Rest& rest : rests(vehicle.ride, scene.duration)) {
                const double time = rest.until - rest.from;
                const Vector2d p = at(vehicle.ride.path, rest.s).position;
                const bool at_kerb = std::abs(p.y()) > jam::parking - 0.5;
                const bool came = rest.from > 0.5, leaves = rest.until < scene.duration - 0.5;
                cyclists += vehicle.kind == VehicleKind::cyclist && came && leaves && time > 5.0;
                bus += vehicle.kind == VehicleKind::bus && came && leaves &&
                       std::abs(time - 40.0) < 1.0;
                van += vehicle.kind == VehicleKind::van && at_kerb && came && leaves &&
                       time > 60.0 && time < 180.0;
                arrivals += vehicle.kind == VehicleKind::car && at_kerb && came && !leaves;
                departures += vehicle.kind == VehicleKind::car && at_kerb && !came && leaves;
                queued += !at_kerb && time > 15.0 && time < 60.0;
            }
        }
        EXPECT_GE(queued, 15U) << seed;
        EXPECT_EQ(bus, 1U) << seed;
        EXPECT_EQ(van, 1U) << seed;
        EXPECT_EQ(arrivals, 2U) << seed;
        EXPECT_EQ(departures, 3U) << seed;
        EXPECT_GE(cyclists, 3U) << seed;
    }
}

TEST(SceneQueue, NoVehicleTouchesAnythingAtAnyTime) { expect_no_touch("queue"); }

TEST(SceneQueue, CarsComeStandAndCreepOnWhileTheSensorPasses) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const Scene scene = entry("queue").make(0, seed);
        EXPECT_TRUE(rests(scene.robot, scene.duration).empty()) << seed;
        std::size_t queued = 0, crept = 0, parked = 0, left = 0;
        for (const Vehicle& vehicle : scene.vehicles) {
            const auto halts = rests(vehicle.ride, scene.duration);
            if (halts.empty()) continue;
            const Vector2d p = at(vehicle.ride.path, halts.front().s).position;
            const bool at_kerb = std::abs(p.y()) > jam::parking - 0.5;
            const bool came = halts.front().from > 0.5;
            queued += !at_kerb && came && halts.front().until - halts.front().from > 8.0;
            for (std::size_t i = 1; i < halts.size() && !at_kerb; ++i) {
                const double way = halts[i].s - halts[i - 1].s;
                crept += way > 0.5 && way < 4.0;
            }
            parked += at_kerb && came;
            left += at_kerb && !came && halts.front().until < scene.duration - 0.5;
        }
        EXPECT_GE(queued, 6U) << seed;
        EXPECT_GE(crept, 6U) << seed;
        EXPECT_EQ(parked, 1U) << seed;
        EXPECT_EQ(left, 2U) << seed;
    }
}

TEST(SceneJam, PeopleWaitGoOnAndKeepOffTheTraffic) {
    for (const std::uint64_t seed : {1U, 2U}) {
        const Scene scene = jam_of(seed, entry("jam").pedestrians);
        const Crowd crowd = walked(scene, scene.duration);
        expect_orderly(scene, crowd, scene.duration, 0.2);
        std::size_t waited = 0, crossed = 0;
        for (std::size_t i = 0; i < crowd.walkers; ++i) {
            const double longest = longest_wait(crowd, i, scene.duration);
            waited += longest > 5.0;
            EXPECT_LT(longest, 100.0) << seed << " " << i;
            double low = 100.0, high = -100.0;
            for (double t = 0.0; t < scene.duration; t += 0.25) {
                const Vector2d p = stride_at(crowd, i, t).position.cast<double>();
                low = std::min(low, p.y());
                high = std::max(high, p.y());
                if (std::abs(p.y()) > jam::kerb) continue;
                for (const Vehicle& vehicle : scene.vehicles) {
                    ASSERT_GT(distance(outline(vehicle.kind, vehicle.ride, t), p), 0.3)
                        << seed << ": " << i << " at " << t << " s, " << p.transpose();
                }
                ASSERT_GT(distance(outline(VehicleKind::car, scene.robot, t), p), 0.3)
                    << seed << ": " << i << " at " << t << " s";
            }
            crossed += low < -jam::kerb && high > jam::kerb;
        }
        EXPECT_GT(waited, 20U) << seed;
        EXPECT_GT(crossed, 10U) << seed;
    }
}

TEST(SceneJam, RobotsPathIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) expect_path_free(jam_of(seed));
}

TEST(SceneJam, SensorIsOnNoBoundaryOfVoxels) { expect_off_boundaries(jam_of(1)); }

}  // namespace dynamic_filter::sim::scene_jam_test
