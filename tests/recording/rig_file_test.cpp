// SPDX-License-Identifier: MIT
#include "recording/rig_file.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace rig_file_test {

class RigFiles : public RecordingFiles {
protected:
    RigFiles() {
        put_bins("front", 1);
        put_bins("rear", 1);
    }
    [[nodiscard]] RigFile read(const std::string& text) const {
        return read_rig_file(data.put("rig.toml", text));
    }
    [[nodiscard]] std::string fault_of(const std::string& text) const {
        return error_of([&] { (void)read(text); });
    }
    /// A sensor, with these lines more.
    static std::string sensor(const std::string& name, const std::string& more = "") {
        return "[[sensor]]\nname = \"" + name + "\"\nrecording = \"" + name + "\"\n" + more + "\n";
    }
};

TEST_F(RigFiles, SaysWhereEachSensorIs) {
    const RigFile rig = read("poses = \"vehicle.tum\"\n" + sensor("front", "at = [1, 0, 0.5]") +
                             sensor("rear",
                                    "at = [-1.5, 0.25, 2]\nturn = [0, 10, 180]\nclock = -0.05\n"
                                    "topic = \"/rear\""));
    EXPECT_EQ(rig.poses, data / "vehicle.tum");
    ASSERT_EQ(rig.sensors.size(), 2U);
    EXPECT_EQ(rig.sensors[0].recording, data / "front");
    EXPECT_TRUE(rig.sensors[0].T_vehicle_sensor->isApprox(Pose(Eigen::Translation3d(1, 0, 0.5))));
    EXPECT_EQ(rig.sensors[0].clock, 0.0);
    const RigEntry& rear = rig.sensors[1];
    EXPECT_EQ(rear.topic, "/rear");
    EXPECT_EQ(rear.clock, -0.05);
    // It looks back, and 10 degrees down.
    const Eigen::Vector3d ahead = rear.T_vehicle_sensor->linear() * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(ahead.x(), -0.98480775301, 1e-9);
    EXPECT_NEAR(ahead.z(), -0.17364817767, 1e-9);
}

TEST_F(RigFiles, AQuaternionIsARotationToo) {
    const RigFile rig =
        read(sensor("front", "at = [0, 0, 0]\nquaternion = [0, 0, 1, 0]") + sensor("rear"));
    EXPECT_TRUE((rig.sensors[0].T_vehicle_sensor->linear() * Eigen::Vector3d::UnitX())
                    .isApprox(-Eigen::Vector3d::UnitX(), 1e-12));
    EXPECT_FALSE(rig.sensors[1].T_vehicle_sensor);
}

TEST_F(RigFiles, MistakesAreNamedWithTheirLine) {
    const std::string front = sensor("front");
    EXPECT_HAS(fault_of(front), "has one sensor");
    EXPECT_HAS(fault_of("[map]\nvoxel_size = 0.2\n"), "[[sensor]]");
    EXPECT_HAS(fault_of("[[sensor]\n"), "(line 1): not TOML");
    EXPECT_HAS(fault_of(front + front), "two sensors of the name 'front'");
    EXPECT_HAS(fault_of(front + sensor("rear", "place = [0, 0, 0]")),
               "(line 8): 'place' is not known");
    EXPECT_HAS(fault_of(front + sensor("rear", "at = [0, 0]")),
               "(line 8): expected at = [x, y, z]");
    EXPECT_HAS(fault_of(front + sensor("rear", "at = [0, 0, nan]")), "at = [x, y, z]");
    EXPECT_HAS(fault_of(front + sensor("rear", "at = [1500, 0, 300]")), "expected metres");
    EXPECT_HAS(fault_of(front + sensor("rear", "turn = [0, 0, 90]")), "no place");
    EXPECT_HAS(fault_of(front + sensor("rear", "at = [0, 0, 0]\nquaternion = [0, 0, 1, 1]")),
               "(line 9): has the length 1.414");
    EXPECT_HAS(fault_of(front + sensor("rear", "at=[0,0,0]\nturn=[0,0,0]\nquaternion=[0,0,0,1]")),
               "keep one");
    EXPECT_HAS(fault_of(front + sensor("rear", "clock = \"late\"")), "clock must be a number");
    EXPECT_HAS(fault_of(front + sensor("rear", "at = [0,0,0]\nfield = \"id\"")), "belong together");
    EXPECT_HAS(fault_of(front + sensor("rear", "field = \"id\"\nvalue = 2")),
               "its place is needed");
    EXPECT_HAS(fault_of(front + sensor("side")), "side does not exist");
    EXPECT_HAS(fault_of(front + "[[sensor]]\nname = \"self\"\nrecording = \"rig.toml\"\n"),
               "is a rig file itself");
    EXPECT_HAS(fault_of(front + "[[sensor]]\nname = \"a/b\"\nrecording = \"rear\"\n"), "letters");
    EXPECT_HAS(fault_of(front + "[[sensor]]\nname = \"other\"\nrecording = \"front\"\n"),
               "those of another sensor");
    EXPECT_HAS(fault_of(front + "[[sensor]]\nrecording = \"rear\"\n"), "has no name");
}

}  // namespace rig_file_test
}  // namespace dynamic_filter::io
