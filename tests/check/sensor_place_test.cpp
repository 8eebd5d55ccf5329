// SPDX-License-Identifier: MIT
#include "check/sensor_place.hpp"

#include "check/motion.hpp"
#include "dynamic_filter/check.hpp"
#include "support/recording.hpp"
#include "support/rings.hpp"

namespace dynamic_filter::app {
namespace sensor_place_test {

class SensorPlace : public io::RecordingFiles {
protected:
    /// Three scans of a standing sensor at `at`.
    void put(const Point& at) const {
        for (unsigned i = 0; i < 3; ++i) {
            std::string bytes;
            for (const Point& p : io::moved(io::scan_of(16, i), at)) {
                bytes += io::floats({p.x(), p.y(), p.z(), 0});
            }
            data.put("velodyne/" + number(i) + ".bin", bytes);
        }
        data.put("poses.txt", kitti_rows(3));
    }
};

TEST_F(SensorPlace, IsFoundAndSaid) {
    put({0.9F, 0.0F, 1.6F});
    io::Recording recording = open();
    EXPECT_HAS(choose_sensor_place(recording), "the beams meet (0.90, 0.00, 1.60) m from");
    EXPECT_EQ(recording.info().sensor_at, Eigen::Vector3d(0.9, 0.0, 1.6));
    EXPECT_EQ(choose_sensor_place(recording), "");  // it is known now
}

TEST_F(SensorPlace, AtTheOriginNothingChanges) {
    put({0.0F, 0.0F, 0.0F});
    io::Recording recording = open();
    EXPECT_EQ(choose_sensor_place(recording), "");
    EXPECT_EQ(recording.read(1).points, open().read(1).points);
    EXPECT_EQ(recording.read(1).T_world_sensor.matrix(), open().read(1).T_world_sensor.matrix());
}

TEST_F(SensorPlace, APlaceThatIsGivenIsKept) {
    put({0.9F, 0.0F, 1.6F});
    io::OpenOptions options;
    options.sensor_at = Eigen::Vector3d::Zero();
    io::Recording recording = open(options);
    EXPECT_EQ(choose_sensor_place(recording), "");
    EXPECT_EQ(recording.info().sensor_at, Eigen::Vector3d::Zero());
}

TEST_F(SensorPlace, PosesAreWrittenInTheFrameOfTheFiles) {
    put({0.9F, 0.0F, 1.6F});
    io::Recording recording = open();
    EXPECT_NE(choose_sensor_place(recording), "");
    write_poses(data / "written.txt", recording);
    const auto written = io::read_poses(data / "written.txt").poses;
    ASSERT_EQ(written.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(written[i].isApprox(open().info().T_world_sensor[i], 1e-9)) << i;
    }
}

}  // namespace sensor_place_test
}  // namespace dynamic_filter::app
