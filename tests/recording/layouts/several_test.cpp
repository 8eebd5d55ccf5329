// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace several_test {

using Several = RecordingFiles;

TEST_F(Several, HelimosAsksForTheSensor) {
    for (const char* sensor : {"Velodyne", "Avia"}) {
        put_bins(std::string(sensor) + "/velodyne", 2);
        data.put(std::string(sensor) + "/poses.txt", kitti_rows(2));
        data.put(std::string(sensor) + "/calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
    }
    EXPECT_HAS(open_error(), "Avia, Velodyne");
    const Recording recording = open_recording(data / "Avia");
    EXPECT_TRUE(
        recording.info().T_world_sensor[1].isApprox(Pose(Eigen::Translation3d(1, 0, 0)), 1e-12));
}

}  // namespace several_test
}  // namespace dynamic_filter::io
