// SPDX-License-Identifier: MIT
#include "run/placed.hpp"

#include <gtest/gtest.h>

#include <random>

#include "dynamic_filter/error.hpp"
#include "recording/scans.hpp"
#include "support/recording.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace placed_test {

Tracked random_motion(std::mt19937& random) {
    std::normal_distribution<double> normal(0.0, 1.0);
    Tracked tracked;
    Twist displacement;
    for (double& number : displacement) number = normal(random);
    for (double& number : tracked.velocity) number = normal(random);
    tracked.T_world_sensor = exp(displacement);
    return tracked;
}

std::vector<std::optional<Tracked>> random_motions(std::size_t count) {
    std::mt19937 random(5);
    std::vector<std::optional<Tracked>> motions;
    for (std::size_t i = 0; i < count; ++i) motions.emplace_back(random_motion(random));
    return motions;
}

class PlacedTest : public io::RecordingFiles {
protected:
    void SetUp() override {
        put_bins("velodyne", 4);
        data.put("poses.txt", kitti_rows(4));
    }
    [[nodiscard]] io::Recording opened() const { return app::open({.data = data.path()}); }
    test::TemporaryFolder result_;
};

TEST_F(PlacedTest, GivesBackEveryBit) {
    auto motions = random_motions(4);
    motions[2].reset();
    const io::Recording recording = io::with_poses(
        io::with_times(opened(), Sweep{.clockwise = true, .seam = 0.1, .duration = 0.3}), motions);
    write_placed(result_.path(), placed_of(recording, {.data = {}, .first = 2}, "these"));
    const auto placed = read_placed(result_.path());
    ASSERT_TRUE(placed);
    EXPECT_EQ(placed->fingerprint, "these");
    EXPECT_EQ(placed->how.first, 2U);
    EXPECT_TRUE(placed->has_times);
    EXPECT_FALSE(placed->deskewed);
    ASSERT_TRUE(placed->sweep);
    EXPECT_EQ(placed->sweep->clockwise, true);
    EXPECT_EQ(placed->sweep->seam, 0.1);
    EXPECT_EQ(placed->sweep->duration, 0.3);
    ASSERT_EQ(placed->tracked.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        ASSERT_EQ(placed->tracked[i].has_value(), motions[i].has_value());
        if (!motions[i]) continue;
        EXPECT_EQ(placed->tracked[i]->T_world_sensor.matrix(), motions[i]->T_world_sensor.matrix());
        EXPECT_EQ(placed->tracked[i]->velocity, motions[i]->velocity);
    }
}

TEST_F(PlacedTest, PlacesThePointsOfTheRunAgain) {
    const io::Recording recording =
        io::with_poses(io::with_times(opened(), Sweep{}), random_motions(4));
    write_placed(result_.path(), placed_of(recording, {}, ""));
    const io::Recording again = placed_again(opened(), *read_placed(result_.path()));
    for (std::size_t i = 0; i < 4; ++i) {
        const io::FullScan as_run = recording.read(i), as_read = again.read(i);
        EXPECT_EQ(as_read.T_world_sensor.matrix(), as_run.T_world_sensor.matrix());
        EXPECT_EQ(as_read.points, as_run.points);
        EXPECT_NE(as_read.points, opened().read(i).points);
    }
}

TEST_F(PlacedTest, ARecordingIsKnownByItsScansPosesAndStamps) {
    const std::string before = fingerprint_of(opened());
    EXPECT_EQ(fingerprint_of(opened()), before);
    data.put("poses.txt",
             "1 0 0 1e-9 0 1 0 0 0 0 1 0\n" + kitti_rows(4).substr(kitti_rows(1).size()));
    EXPECT_NE(fingerprint_of(opened()), before);
    data.put("poses.txt", kitti_rows(4));
    EXPECT_EQ(fingerprint_of(opened()), before);
    // As a copy in metres looks if it is read in the unit of the run.
    EXPECT_NE(fingerprint_of(app::open({.data = data.path(), .point_unit = "mm"})), before);
    data.put("times.txt", "0\n0.1\n0.2\n0.3\n");
    EXPECT_NE(fingerprint_of(opened()), before);
}

TEST_F(PlacedTest, ADamagedFileIsNamed) {
    EXPECT_FALSE(read_placed(result_.path()));
    for (const char* damaged : {"{\"version\": 1", "{\"version\": 2}", "{\"version\": 1}"}) {
        test::spill(result_ / kPlacedFile, damaged);
        EXPECT_THROW(read_placed(result_.path()), InputError) << damaged;
    }
}

}  // namespace placed_test
}  // namespace dynamic_filter::app
