// SPDX-License-Identifier: MIT
#include "dynamic_filter/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::sim {
namespace simulation_test {

SimulationOptions short_run(const std::string& scene) {
    SimulationOptions options;
    options.scene = scene;
    options.frames = 3;
    return options;
}

void expect_equal(const SimulatedScan& a, const SimulatedScan& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.labels, b.labels);
    EXPECT_EQ(a.intensity, b.intensity);
    EXPECT_EQ(a.kinds, b.kinds);
    EXPECT_EQ(a.instances, b.instances);
    EXPECT_EQ(a.T_world_sensor.matrix(), b.T_world_sensor.matrix());
    EXPECT_EQ(a.stamp, b.stamp);
    EXPECT_EQ(a.times, b.times);
}

TEST(Simulation, SameOptionsSameBytesWhateverTheThreadsAndTheOrder) {
    for (const auto& scene : scene_names()) {
        Simulation one(short_run(scene)), two(short_run(scene));
        for (const std::size_t i : {2U, 0U, 1U}) {
            SimulatedScan a, b;
            with_threads(1, [&] { a = one.scan(i); });
            with_threads(2, [&] { b = two.scan(2 - i), b = two.scan(i); });
            expect_equal(a, b);
        }
    }
}

// What two sensors of a vehicle see is one scene at one time.
TEST(Simulation, AnotherMountIsAnotherSensorInTheSameScene) {
    SimulationOptions options = short_run("street");
    options.sensor = "os64";
    Simulation own(options);
    options.mount.translation() << -1.0, 0.3, 0.5;
    options.mount.linear() = Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    options.delay = 0.05;
    Simulation other(options);
    for (const std::size_t i : {0U, 2U}) {
        const SimulatedScan a = own.scan(i), b = other.scan(i);
        EXPECT_DOUBLE_EQ(b.stamp, a.stamp + 0.05);
        EXPECT_TRUE(b.T_world_sensor.isApprox(own.exact_pose(b.stamp) * options.mount, 1e-9));
        EXPECT_GT(b.points.size(), a.points.size() / 2);
        std::set<std::uint16_t> of_a(a.instances.begin(), a.instances.end());
        const auto common = std::count_if(b.instances.begin(), b.instances.end(),
                                          [&](std::uint16_t k) { return of_a.contains(k); });
        EXPECT_GT(common, std::ssize(b.instances) / 2);
    }
}

TEST(Simulation, RefusesADelayOfAWholeScan) {
    SimulationOptions options = short_run("crowd");
    options.delay = 5.0;
    EXPECT_THROW(Simulation{options}, ConfigError);
}

TEST(Simulation, SeedsDiffer) {
    for (const auto& scene : scene_names()) {
        SimulationOptions options = short_run(scene);
        Simulation one(options);
        options.seed = 2;
        Simulation two(options);
        EXPECT_NE(one.scan(1).points, two.scan(1).points) << scene;
    }
}

TEST(Simulation, RoundsMakeTheCrowdLongerAndItsBeginningTheSame) {
    SimulationOptions options;
    options.pedestrians = 20;
    Simulation two(options);
    options.rounds = 2;
    EXPECT_EQ(Simulation(options).size(), two.size());
    options.rounds = 8;
    Simulation eight(options);
    EXPECT_NEAR(static_cast<double>(eight.size()), 4.0 * static_cast<double>(two.size()), 4.0);
    expect_equal(two.scan(5), eight.scan(5));
    EXPECT_GT(eight.scan(eight.size() - 1).points.size(), 10000U);
    options = {};
    options.pedestrians = 0;
    options.rate_hz = 10.0;
    EXPECT_NEAR(static_cast<double>(Simulation(options).size()), 2590.0, 60.0);
}

TEST(Simulation, LabelsAreStillOrDynamic) {
    for (const auto& scene : scene_names()) {
        Simulation simulation(short_run(scene));
        const SimulatedScan scan = simulation.scan(1);
        std::size_t still = 0, dynamic = 0;
        for (const Label label : scan.labels) {
            still += label == Label::static_;
            dynamic += label == Label::dynamic;
        }
        EXPECT_EQ(still + dynamic, scan.points.size()) << scene;
        EXPECT_GT(still, 1000U) << scene;
        EXPECT_GT(dynamic, 50U) << scene;
    }
}

TEST(Simulation, KindsAgreeWithLabels) {
    for (const auto& scene : scene_names()) {
        Simulation simulation(short_run(scene));
        const SimulatedScan scan = simulation.scan(1);
        ASSERT_EQ(scan.kinds.size(), scan.points.size());
        for (std::size_t i = 0; i < scan.kinds.size(); ++i) {
            const bool dynamic =
                scan.kinds[i] == Kind::walking || scan.kinds[i] == Kind::standing ||
                scan.kinds[i] == Kind::vehicle || scan.kinds[i] == Kind::temporary ||
                scan.kinds[i] == Kind::reflection;
            EXPECT_EQ(scan.labels[i], dynamic ? Label::dynamic : Label::static_) << scene;
        }
    }
}

// A person is 1.75 m tall and carries a suitcase at most; what counts as one is in one place.
TEST(Simulation, PointsOfOnePersonLieTogether) {
    for (const auto& scene : scene_names()) {
        const SimulatedScan scan = Simulation(short_run(scene)).scan(1);
        ASSERT_EQ(scan.instances.size(), scan.points.size());
        std::map<std::uint16_t, Eigen::AlignedBox3f> people;
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            if (scan.kinds[i] == Kind::reflection) continue;  // also of static things
            EXPECT_EQ(scan.instances[i] > 0, is_dynamic(scan.kinds[i])) << scene;
            if (scan.kinds[i] == Kind::walking || scan.kinds[i] == Kind::standing) {
                people[scan.instances[i]].extend(scan.points[i]);
            }
        }
        for (const auto& [instance, box] : people) EXPECT_LT(box.diagonal().norm(), 3.0F) << scene;
    }
}

TEST(Simulation, EveryKindIsSeenWhereItIs) {
    std::map<std::string, std::set<Kind>> seen;
    for (const auto& scene : scene_names()) {
        SimulationOptions options;
        options.scene = scene;
        Simulation simulation(options);
        const std::size_t step = std::max<std::size_t>(20, simulation.size() / 20);
        for (std::size_t i = 0; i < simulation.size(); i += step) {
            const SimulatedScan scan = simulation.scan(i);
            seen[scene].insert(scan.kinds.begin(), scan.kinds.end());
        }
    }
    EXPECT_EQ(seen["crowd"].count(Kind::vehicle), 0U);
    for (const auto& [scene, kinds] : seen) {  // only the city has several drives
        EXPECT_EQ(kinds.count(Kind::temporary), scene == "city" ? 1U : 0U) << scene;
        EXPECT_EQ(kinds.count(Kind::reflection), scene == "mirrors" ? 1U : 0U) << scene;
    }
    EXPECT_EQ(seen["crowd"].size(), kind_names.size() - 3);
    EXPECT_EQ(seen["street"].size(), kind_names.size() - 2);
    EXPECT_EQ(seen["square"].size(), kind_names.size() - 2);
    EXPECT_EQ(seen["hall"].size(), kind_names.size() - 3);  // no vehicles
    EXPECT_EQ(seen["jam"].size(), kind_names.size() - 2);
    EXPECT_EQ(seen["queue"].size(), kind_names.size() - 2);
    EXPECT_EQ(seen["platform"].size(), kind_names.size() - 3);  // nothing grows
    EXPECT_EQ(seen["slow"].size(), kind_names.size() - 2);
    EXPECT_EQ(seen["mirrors"].size(), kind_names.size() - 2);  // no vehicles
    EXPECT_EQ(seen["city"].size(), kind_names.size() - 1);
}

TEST(Simulation, GroundIsAtTheGroundAndOthersMostlyAreNot) {
    const std::map<std::string, double> highest = {
        {"crowd", 0.0},  {"street", 0.15},  {"square", 0.8}, {"hall", 4.0},    {"jam", 0.15},
        {"queue", 0.15}, {"platform", 2.4}, {"slow", 0.0},   {"mirrors", 0.0}, {"city", 0.15}};
    const auto lowest = [](const std::string& scene) { return scene == "platform" ? -1.1 : 0.0; };
    for (const auto& scene : scene_names()) {
        Simulation simulation(short_run(scene));
        const SimulatedScan scan = simulation.scan(0);
        std::size_t low = 0, others = 0;
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            const double z = (scan.T_world_sensor * scan.points[i].cast<double>()).z() - 0.05;
            if (scan.kinds[i] == Kind::reflection) continue;  // also of the ground
            if (scan.kinds[i] == Kind::ground) {
                EXPECT_GT(z, lowest(scene) - 0.1) << scene;
                EXPECT_LT(z, highest.at(scene) + 0.1) << scene;
            } else {
                ++others;
                low += std::abs(z) < 0.1;
            }
        }
        EXPECT_LT(static_cast<double>(low), 0.1 * static_cast<double>(others)) << scene;
    }
}

TEST(Simulation, GroundIsFlatAndNothingIsBelow) {
    Simulation simulation(short_run("crowd"));
    const SimulatedScan scan = simulation.scan(0);
    std::size_t ground = 0;
    for (const Point& point : scan.points) {
        const double z = (scan.T_world_sensor * point.cast<double>()).z();
        EXPECT_GT(z, -0.1);
        ground += std::abs(z) < 0.1;
    }
    EXPECT_GT(ground, 500U);
}

TEST(Simulation, RangesAreWithinTheSensorsLimits) {
    for (const auto& sensor : sensor_names()) {
        SimulationOptions options = short_run("street");
        options.sensor = sensor;
        Simulation simulation(options);
        const SimulatedScan scan = simulation.scan(2);
        ASSERT_FALSE(scan.points.empty()) << sensor;
        for (const Point& point : scan.points) {
            EXPECT_GE(point.norm(), 0.399F);
            EXPECT_LE(point.norm(), 150.01F);
        }
    }
}

TEST(Simulation, PoseNoiseHasTheAskedDeviation) {
    SimulationOptions options;
    options.pedestrians = 0;
    Simulation exact(options);
    options.pose_noise_m = 0.05;
    options.pose_noise_deg = 0.5;
    Simulation noisy(options);
    double shift = 0.0, turn = 0.0;
    const std::size_t n = noisy.size();
    for (std::size_t i = 0; i < n; i += 3) {
        const Pose a = exact.scan(i).T_world_sensor, b = noisy.scan(i).T_world_sensor;
        shift += (b.translation() - a.translation()).squaredNorm();
        const double angle = Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
        turn += angle * angle;
    }
    const double draws = 3.0 * std::ceil(static_cast<double>(n) / 3.0);
    EXPECT_NEAR(std::sqrt(shift / draws), 0.05, 0.006);
    EXPECT_NEAR(std::sqrt(turn / draws) * 180.0 / std::numbers::pi, 0.5, 0.06);
}

TEST(Simulation, PoseNoiseLeavesThePointsAlone) {
    SimulationOptions options = short_run("crowd");
    Simulation exact(options);
    options.pose_noise_m = 0.05;
    Simulation noisy(options);
    EXPECT_EQ(exact.scan(1).points, noisy.scan(1).points);
}

TEST(Simulation, NobodyNothingDynamic) {
    SimulationOptions options = short_run("crowd");
    options.pedestrians = 0;
    Simulation simulation(options);
    const SimulatedScan scan = simulation.scan(1);
    EXPECT_EQ(std::count(scan.labels.begin(), scan.labels.end(), Label::dynamic), 0);
    EXPECT_GT(scan.points.size(), 10000U);
}

TEST(Simulation, LengthFollowsFramesAndRate) {
    SimulationOptions options;
    options.pedestrians = 0;
    EXPECT_NEAR(static_cast<double>(Simulation(options).size()), 325.0, 15.0);
    options.rate_hz = 2.5;
    EXPECT_NEAR(static_cast<double>(Simulation(options).size()), 650.0, 30.0);
    options.frames = 4;
    Simulation simulation(options);
    EXPECT_EQ(simulation.size(), 4U);
    EXPECT_DOUBLE_EQ(simulation.scan(3).stamp, 1.2);
    options = {};
    options.scene = "street";
    EXPECT_EQ(Simulation(options).size(), 300U);
}

SimulationOptions sweeping(const std::string& scene) {
    SimulationOptions options = short_run(scene);
    options.sweep = true;
    return options;
}

TEST(Simulation, DrivesAreInOneWorldAndDoNotDependOnTheirNumber) {
    SimulationOptions options = short_run("city");
    options.km = 0.1;
    options.drive = 2;
    options.drives = 2;
    EXPECT_EQ(drive_count(options), 2);
    const SimulatedScan few = Simulation(options).scan(1);
    options.drives = 5;
    const SimulatedScan many = Simulation(options).scan(1);
    EXPECT_EQ(few.points, many.points);
    EXPECT_EQ(few.T_world_sensor.matrix(), many.T_world_sensor.matrix());
    options.drive = 1;
    const SimulatedScan other = Simulation(options).scan(1);
    EXPECT_NE(other.T_world_sensor.matrix(), few.T_world_sensor.matrix());
    EXPECT_EQ(drive_count(short_run("street")), 0);
}

TEST(Simulation, LengthFollowsKilometres) {
    SimulationOptions options = short_run("city");
    options.frames = {};
    options.km = 0.1;
    Simulation simulation(options);
    double way = 0.0;
    Eigen::Vector3d last = simulation.scan(0).T_world_sensor.translation();
    for (std::size_t i = 1; i < simulation.size(); i += 5) {
        const Eigen::Vector3d next = simulation.scan(i).T_world_sensor.translation();
        way += (next - last).norm();
        last = next;
    }
    EXPECT_NEAR(way, 100.0, 6.0);
}

TEST(Simulation, SweepsHaveTheSameBytesWhateverTheThreadsAndTheOrder) {
    Simulation one(sweeping("street")), two(sweeping("street"));
    for (const std::size_t i : {2U, 0U, 1U}) {
        SimulatedScan a, b;
        with_threads(1, [&] { a = one.scan(i); });
        with_threads(2, [&] { b = two.scan(2 - i), b = two.scan(i); });
        expect_equal(a, b);
    }
}

TEST(Simulation, PointsOfASweepHaveTimesAndThoseOfASnapshotNone) {
    for (const auto& scene : scene_names()) {
        EXPECT_TRUE(Simulation(short_run(scene)).scan(0).times.empty());
        SimulationOptions options = sweeping(scene);
        for (const double rate : {2.0, 20.0}) {
            options.rate_hz = rate;
            const SimulatedScan scan = Simulation(options).scan(1);
            const auto duration = static_cast<float>(std::min(0.2, 1.0 / rate));
            ASSERT_EQ(scan.times.size(), scan.points.size());
            EXPECT_TRUE(std::is_sorted(scan.times.begin(), scan.times.end()));
            EXPECT_GE(scan.times.front(), 0.0F);
            EXPECT_LT(scan.times.back(), duration);
            EXPECT_GT(scan.times.back(), 0.9F * duration);
            EXPECT_EQ(scan.labels.size(), scan.points.size());
            EXPECT_EQ(scan.stamp, 1.0 / rate);
        }
    }
}

TEST(Simulation, ASweepBeginsAsASnapshotDoes) {
    SimulationOptions options = short_run("street");
    const SimulatedScan snapshot = Simulation(options).scan(1);
    options.sweep = true;
    const SimulatedScan sweep = Simulation(options).scan(1);
    EXPECT_EQ(snapshot.T_world_sensor.matrix(), sweep.T_world_sensor.matrix());
    double near = 0.0;
    for (std::size_t i = 0; i < 300; ++i) {
        near += (snapshot.points[i] - sweep.points[i]).norm() < 0.2F;
    }
    EXPECT_GT(near, 270.0);
    EXPECT_NE(snapshot.points, sweep.points);
}

TEST(Simulation, WrongOptionsAreNamed) {
    const auto message = [](const SimulationOptions& options) -> std::string {
        try {
            Simulation simulation(options);
        } catch (const ConfigError& error) {
            return error.what();
        }
        return "";
    };
    SimulationOptions options;
    options.scene = "moon";
    EXPECT_NE(
        message(options).find("crowd, street, square, hall, jam, queue, platform, slow, mirrors"),
        std::string::npos);
    options = {};
    options.sensor = "eye";
    EXPECT_NE(message(options).find("vlp16"), std::string::npos);
    options = {};
    options.pedestrians = -2;
    EXPECT_NE(message(options), "");
    options = {};
    options.rate_hz = -1.0;
    EXPECT_NE(message(options), "");
    options = {};
    options.scene = "street";
    options.frames = 301;
    EXPECT_NE(message(options).find("300 scans"), std::string::npos);
    options.rate_hz = 5.0;
    EXPECT_NE(message(options).find("150 scans"), std::string::npos);
    options.rate_hz = 20.0;
    EXPECT_EQ(message(options), "");
    options = {};
    options.pose_noise_m = std::nan("");
    EXPECT_NE(message(options), "");
    options = {};
    options.rounds = -1;
    EXPECT_NE(message(options), "");
    options.rounds = 2;
    EXPECT_EQ(message(options), "");
    for (const auto& scene : scene_names()) {
        if (scene == "crowd") continue;
        options.scene = scene;
        EXPECT_NE(message(options).find("it does in crowd"), std::string::npos) << scene;
    }
    options = {};
    options.km = 2.0;
    EXPECT_NE(message(options).find("with drives: city"), std::string::npos);
    options.scene = "city";
    options.km = 81.0;
    EXPECT_NE(message(options).find("km is 81"), std::string::npos);
    options.km = 0.1;
    options.drive = 4;
    EXPECT_NE(message(options).find("expected 1 to 3"), std::string::npos);
    options.drives = -1;
    EXPECT_NE(message(options).find("drives is -1"), std::string::npos);
}

}  // namespace simulation_test
}  // namespace dynamic_filter::sim
