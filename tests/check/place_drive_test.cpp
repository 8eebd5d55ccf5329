// SPDX-License-Identifier: MIT
#include "check/place_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/degree.hpp"
#include "commands/write_simulation.hpp"
#include "support/changed.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace place_drive_test {

/// Every second scan of a street is a drive of its own.
struct PlaceDrive : testing::Test {
    static void SetUpTestSuite() {
        folder = new TemporaryFolder;
        for (const char* scene : {"street", "square"}) {
            sim::SimulationOptions options;
            options.scene = scene;
            options.sensor = "vlp16";
            options.rate_hz = 3.0;
            options.frames = 36;
            std::filesystem::create_directories(*folder / scene);
            app::write_simulation(options, *folder / scene, true);
        }
    }
    static void TearDownTestSuite() { delete std::exchange(folder, nullptr); }

    static Recording drive(const char* scene, std::size_t first) {
        OpenOptions how;
        how.first = first;
        how.stride = 2;
        return open_recording(*folder / scene, how);
    }
    static PlacedDrive placed(const Recording& drive) {
        const Recording* const map[] = {&of_map()};
        return place_drive(drive, map);
    }
    static const Recording& of_map() {
        static const Recording recording = drive("street", 0);
        return recording;
    }
    static void expect_true_poses(const PlacedDrive& placed, const Recording& truth,
                                  double shift = 0.05) {
        EXPECT_TRUE(placed.fits())
            << placed.fitting << " of " << placed.places << ", through " << placed.through;
        ASSERT_EQ(placed.T_world_sensor.size(), truth.size());
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Pose error = placed.T_world_sensor[i].inverse() * truth.info().T_world_sensor[i];
            EXPECT_LT(error.translation().norm(), shift) << i;
            EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.2 * kDegree) << i;
        }
    }
    static inline TemporaryFolder* folder = nullptr;
};

Pose turned_by(double degrees, const Eigen::Vector3d& axis) {
    return Pose(Eigen::AngleAxisd(degrees * kDegree, axis));
}

TEST_F(PlaceDrive, RightPosesStay) {
    const Recording truth = drive("street", 1);
    const PlacedDrive found = placed(truth);
    expect_true_poses(found, truth);
    EXPECT_FALSE(found.is_found);
    EXPECT_LT(found.moved, 0.05);
}

TEST_F(PlaceDrive, PosesThatAreOffAndDriftAreBentOntoTheMap) {
    const Recording truth = drive("street", 1);
    int scan = 0;
    const Recording off = with_changed_poses(truth, [&](const Pose& pose) {
        const double drift = 0.03 * scan++;
        return Eigen::Translation3d(1.5, -1.0 + drift, 0.3) *
               turned_by(1.0, Eigen::Vector3d::UnitZ()) * pose;
    });
    const PlacedDrive found = placed(off);
    // Scans around a place are as far apart as the poses drift there.
    expect_true_poses(found, truth, 0.12);
    EXPECT_GT(found.moved, 1.0);
}

TEST_F(PlaceDrive, AWorldOfItsOwnIsFoundByWhatPlacesLookLike) {
    const Recording truth = drive("street", 1);
    const Recording own = with_changed_poses(truth, [&](const Pose& pose) {
        return Eigen::Translation3d(400.0, -250.0, 12.0) *
               turned_by(137.0, Eigen::Vector3d::UnitZ()) *
               turned_by(1.0, Eigen::Vector3d::UnitX()) * pose;
    });
    const PlacedDrive found = placed(own);
    expect_true_poses(found, truth);
    EXPECT_TRUE(found.is_found);
}

TEST_F(PlaceDrive, AnotherPlaceDoesNotFit) { EXPECT_FALSE(placed(drive("square", 1)).fits()); }

}  // namespace place_drive_test
}  // namespace dynamic_filter::io
