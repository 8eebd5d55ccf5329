// SPDX-License-Identifier: MIT
#include "recording/rig.hpp"

#include "dynamic_filter/error.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace rig_test {

/// A vehicle that goes 1 m in 0.2 s along x, with one sensor 1 m ahead and one 1 m behind that
/// looks back. The rear one measures 0.1 s later.
class Rigs : public RecordingFiles {
protected:
    Rigs() {
        put_sensor("front", 0.0);
        put_sensor("rear", 0.1);
        data.put("vehicle.tum", tum_rows(12));
    }
    void put_sensor(const std::string& name, double first) const {
        put_bins(name + "/velodyne", 10);
        std::string times;
        for (int i = 0; i < 10; ++i) times += std::to_string(first + 0.2 * i) + "\n";
        data.put(name + "/times.txt", times);
    }
    void put_rig(const std::string& top = "poses = \"vehicle.tum\"\n",
                 const std::string& of_rear = "") const {
        data.put("rig.toml", top +
                                 "[[sensor]]\nname = \"front\"\nrecording = \"front\"\n"
                                 "at = [1, 0, 0]\n"
                                 "[[sensor]]\nname = \"rear\"\nrecording = \"rear\"\n"
                                 "at = [-1, 0, 0]\nturn = [0, 0, 180]\n" +
                                 of_rear);
    }
    [[nodiscard]] Recording rig(const OpenOptions& options = {}) const {
        return open_recording(data / "rig.toml", options);
    }
    [[nodiscard]] std::string fault(const OpenOptions& options = {}) const {
        return error_of([&] { (void)rig(options); });
    }
};

TEST_F(Rigs, ScansTakeTurnsAndEachHasThePoseOfItsSensor) {
    put_rig();
    const Recording recording = rig();
    ASSERT_EQ(recording.size(), 20U);
    EXPECT_EQ(recording.info().layout, "rig");
    EXPECT_EQ(stem(recording, 0), "front_000000");
    EXPECT_EQ(stem(recording, 1), "rear_000000");
    EXPECT_DOUBLE_EQ(recording.info().stamps[3], 0.3);
    EXPECT_NEAR(recording.info().T_world_sensor[2].translation().x(), 2.0, 1e-9);
    EXPECT_NEAR(recording.info().T_world_sensor[3].translation().x(), 0.5, 1e-9);
    const FullScan scan = recording.read(3);
    EXPECT_EQ(scan.sensor, 1U);
    EXPECT_EQ(values(scan.cloud, *scan.cloud.find("sensor")), (std::vector<double>{1, 1}));
    EXPECT_EQ(scan.points, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_TRUE((scan.T_world_sensor * Eigen::Vector3d(1, 2, 3))
                    .isApprox(Eigen::Vector3d(0.5 - 1, -2, 3), 1e-6));
    EXPECT_FALSE(recording.info().has_truth());
}

TEST_F(Rigs, AStrideIsThatOfEachSensor) {
    put_rig();
    OpenOptions options;
    options.first = 2;
    options.stride = 3;
    const Recording recording = rig(options);
    ASSERT_EQ(recording.size(), 6U);
    EXPECT_EQ(stem(recording, 0), "front_000001");
    EXPECT_EQ(stem(recording, 1), "rear_000001");
    EXPECT_EQ(stem(recording, 3), "rear_000004");
    EXPECT_EQ(by_sensor(recording).size(), 2U);
}

TEST_F(Rigs, AClockIsAddedToTheStamps) {
    put_rig("poses = \"vehicle.tum\"\n", "clock = -0.02\n");
    const Recording recording = rig();
    EXPECT_DOUBLE_EQ(recording.info().stamps[1], 0.08);
    EXPECT_NEAR(recording.info().T_world_sensor[1].translation().x(), 0.4 - 1.0, 1e-9);
}

TEST_F(Rigs, PosesOfOneSensorPlaceTheOthers) {
    put_rig("");
    data.put("front/poses.txt", kitti_rows(10));  // 1 m a scan, from x = 0 of the front sensor
    const Recording recording = rig();
    EXPECT_TRUE(has_note(recording, "the poses are those of sensor 'front'"));
    EXPECT_NEAR(recording.info().T_world_sensor[3].translation().x(), 1.5 - 2.0, 1e-9);
    // The last scan of the rear sensor comes half a step after the last pose.
    EXPECT_NEAR(recording.info().T_world_sensor[19].translation().x(), 9.5 - 2.0, 1e-9);
    put_rig("poses = \"vehicle.tum\"\n");
    EXPECT_NEAR(rig().info().T_world_sensor[3].translation().x(), 0.5, 1e-9);
    OpenOptions options;
    options.without_poses = true;
    EXPECT_FALSE(rig(options).info().has_poses);
}

TEST_F(Rigs, GroundTruthIsThatOfEachSensor) {
    put_rig();
    for (std::size_t i = 0; i < 10; ++i) {
        data.put("rear/labels/" + number(i) + ".label",
                 bytes_of(std::uint32_t{252}) + bytes_of(std::uint32_t{40}));
    }
    const Recording recording = rig();
    EXPECT_TRUE(recording.info().has_truth());
    EXPECT_TRUE(recording.read(0).truth.empty());
    EXPECT_EQ(recording.read(1).truth, (Labels{Label::dynamic, Label::static_}));
}

TEST_F(Rigs, CloudsThatWereMergedAreTakenApart) {
    put_rig();
    // Intensity 0.5 are all points of `rear`; one more sensor is in clouds of the vehicle's frame.
    for (std::size_t i = 0; i < 10; ++i) {
        data.put("merged/velodyne/" + number(i) + ".bin",
                 floats({9, 9, 9, 1, 1, 0, 5, 2, 0, 0, 0, 2}));
        data.put("merged/labels/" + number(i) + ".label", bytes_of(std::uint32_t{40}) +
                                                              bytes_of(std::uint32_t{252}) +
                                                              bytes_of(std::uint32_t{40}));
    }
    data.put("merged/times.txt", test::slurp(data / "front/times.txt"));
    const auto entry = [](const char* name, int value) {
        return std::string(
                   "[[sensor]]\nrecording = \"merged\"\nat = [0, 0, 2]\nfield = "
                   "\"intensity\"\nname = \"") +
               name + "\"\nvalue = " + std::to_string(value) + "\n";
    };
    data.put("rig.toml", "poses = \"vehicle.tum\"\n" + entry("a", 1) + entry("b", 2));
    const Recording recording = rig();
    ASSERT_EQ(recording.size(), 20U);
    EXPECT_EQ(recording.read(0).points, (Points{{9, 9, 7}}));
    EXPECT_EQ(recording.read(1).points, (Points{{1, 0, 3}, {0, 0, 0}}));
    EXPECT_EQ(recording.read(1).T_world_sensor.translation().z(), 2.0);
    EXPECT_EQ(recording.read(1).truth, (Labels{Label::dynamic, Label::static_}));
    EXPECT_EQ(stem(recording, 1), "b_000000");
}

// The poses that come with merged clouds are those of their frame, which is the vehicle's.
TEST_F(Rigs, PosesOfMergedCloudsAreThoseOfTheVehicle) {
    for (std::size_t i = 0; i < 10; ++i) {
        data.put("merged/velodyne/" + number(i) + ".bin", floats({9, 9, 9, 1, 1, 0, 5, 2}));
    }
    data.put("merged/times.txt", test::slurp(data / "front/times.txt"));
    data.put("merged/poses.txt", kitti_rows(10));
    const std::string entries =
        "[[sensor]]\nname = \"a\"\nrecording = \"merged\"\nat = [0, 0, 2]\nfield = "
        "\"intensity\"\nvalue = 1\n[[sensor]]\nname = \"b\"\nrecording = \"merged\"\nat = [1, "
        "0, 3]\nfield = \"intensity\"\nvalue = 2\n";
    data.put("rig.toml", entries);
    const Recording both = rig();
    EXPECT_EQ(both.info().T_world_sensor[2].translation(), Eigen::Vector3d(1, 0, 2));
    EXPECT_EQ(both.info().T_world_sensor[3].translation(), Eigen::Vector3d(2, 0, 3));
    // One of them beside a sensor that has no poses.
    data.put("rig.toml",
             entries.substr(0, entries.find("[[sensor]]", 5)) +
                 "[[sensor]]\nname = \"rear\"\nrecording = \"rear\"\nat = [-1, 0, 0]\n");
    const Recording one = rig();
    EXPECT_NEAR(one.info().T_world_sensor[0].translation().z(), 2.0, 1e-9);
    EXPECT_NEAR(one.info().T_world_sensor[1].translation().x(), 0.5 - 1.0, 1e-9);
    EXPECT_NEAR(one.info().T_world_sensor[1].translation().z(), 0.0, 1e-9);
}

TEST_F(Rigs, BoxesOfTheOwnBodyAreInTheFrameOfTheVehicle) {
    put_rig();
    OpenOptions options;
    options.own_body = {Eigen::AlignedBox3f(Point(-2.5F, -2.5F, 2), Point(-1.5F, -1.5F, 4))};
    const Recording recording = rig(options);
    EXPECT_TRUE(recording.read(0).own.empty());
    EXPECT_EQ(recording.read(1).own, (std::vector<std::uint8_t>{1, 0}));
}

TEST_F(Rigs, NamesOfScansThatWouldBeTheSameAreRefused) {
    data.put("a/b_000000.bin", floats({1, 2, 3, 0.5F}));
    data.put("a/b_000001.bin", floats({1, 2, 3, 0.5F}));
    data.put("b/000000.bin", floats({1, 2, 3, 0.5F}));
    data.put("b/000001.bin", floats({1, 2, 3, 0.5F}));
    for (const char* name : {"a", "b"}) data.put(std::string(name) + "/times.txt", "0\n0.2\n");
    data.put("rig.toml",
             "[[sensor]]\nname = \"a\"\nrecording = \"a\"\nat = [0, 0, 0]\n"
             "[[sensor]]\nname = \"a_b\"\nrecording = \"b\"\nat = [0, 0, 0]\n");
    EXPECT_HAS(fault(), "two scans would have the name a_b_000000");
}

TEST_F(Rigs, FaultsAreNamed) {
    put_rig("");
    EXPECT_FALSE(rig().info().has_poses);
    OpenOptions options;
    options.topic = "/points";
    EXPECT_HAS(error_of<ConfigError>([&] { (void)rig(options); }),
               "--topic is for the recording of one sensor");
    options.topic.clear();
    options.own_body = {Eigen::AlignedBox3f(Point(0, 0, 0), Point(1, 1, 1))};
    EXPECT_TRUE(rig(options).read(0).own.empty());
    put_rig("poses = \"missing.tum\"\n");
    EXPECT_HAS(fault(), "missing.tum");
    data.put("rows.txt", kitti_rows(10));
    put_rig("poses = \"rows.txt\"\n");
    EXPECT_HAS(fault(), "rows.txt: has no stamps");
    data.put("late.tum", tum_rows(10, 1000.0));
    put_rig("poses = \"late.tum\"\n");
    EXPECT_HAS(fault(), "near in time to 0 of 20 scans");
    put_rig("poses = \"vehicle.tum\"\n", "clock = 100\n");
    EXPECT_HAS(fault(), "sensor 'rear': its scans are from 100.1");
    std::filesystem::remove(data / "rear/times.txt");
    put_rig();
    EXPECT_HAS(fault(), "sensor 'rear': its scans have no stamps");
    std::filesystem::remove_all(data / "rear/velodyne");
    EXPECT_HAS(fault(), "rear");
    options.layout = "rig";
    EXPECT_HAS(error_of([&] { (void)open_recording(data / "front", options); }), "front");
}

}  // namespace rig_test
}  // namespace dynamic_filter::io
