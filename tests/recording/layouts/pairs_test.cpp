// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace pairs_test {

using Pairs = RecordingFiles;

std::string odom(double x) {
    return "1 0 0 " + std::to_string(x) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
}

TEST_F(Pairs, PosesAreInTheFilesBesideTheScans) {
    put_pcd("1500000000_900000000.pcd", 0, 0);
    put_pcd("1500000001_000000000.pcd", 0, 0);
    data.put("1500000000_900000000.odom", odom(3));
    data.put("1500000001_000000000.odom", odom(4));
    const Recording recording = open();
    ASSERT_EQ(recording.size(), 2U);
    EXPECT_TRUE(has_note(recording, ".odom"));
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 4.0);
    EXPECT_NEAR(recording.info().stamps[1] - recording.info().stamps[0], 0.1, 1e-6);
    EXPECT_TRUE(recording.info().measured_stamps);
    EXPECT_EQ(recording.read(0).points.size(), 2U);
    OpenOptions options;
    options.poses = data.put("p.txt", kitti_rows(2));
    EXPECT_EQ(open(options).info().T_world_sensor[1].translation().x(), 1.0);
}

TEST_F(Pairs, FaultsAreNamed) {
    put_pcd("a.pcd", 0, 0);
    const auto with = [&](const std::string& text) {
        data.put("a.odom", text);
        return open_error();
    };
    EXPECT_HAS(with("1 0 0 0\n0 1 0 0\n0 0 1 0\n"), "3 rows");
    EXPECT_HAS(with("1 0 0 0\n0 1 0\n"), "line 2");
    EXPECT_HAS(with(odom(0) + "1 2 3 4\n"), "more than");
    EXPECT_HAS(with("1 0 0 a\n"), "'a'");
    EXPECT_HAS(with("2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n"), "scaled");
    EXPECT_HAS(with("1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 1\n"), "last row");
    data.put("a.odom", odom(0));
    EXPECT_TRUE(has_note(open(), "10 Hz"));
    put_pcd("b.pcd", 0, 0);
    EXPECT_HAS(open_error(), "no b.odom");
    std::filesystem::remove(data / "b.pcd");
    data.put("c.odom", odom(0));
    EXPECT_HAS(open_error(), "no c.pcd");
    std::filesystem::remove(data / "c.odom");
    put_pcd("a.PCD", 0, 0);  // two scans, one pose
    EXPECT_EQ(open().info().T_world_sensor.size(), 2U);
}

}  // namespace pairs_test
}  // namespace dynamic_filter::io
