// SPDX-License-Identifier: MIT
#include "recording/matching.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace matching_test {

using MatchingTest = RecordingFiles;

TEST_F(MatchingTest, CountsThatDiffer) {
    put_bins("velodyne", 3);
    data.put("poses.txt", kitti_rows(4));
    const std::string error = open_error();
    EXPECT_HAS(error, "3 scans");
    EXPECT_HAS(error, "4 poses");
    EXPECT_HAS(error, "velodyne");
    EXPECT_HAS(error, "--stride");
    data.put("poses.txt", tum_rows(4));  // indices in file names are no times
    EXPECT_HAS(open_error(), "4 poses");
}

TEST_F(MatchingTest, TimesInFileNames) {
    for (const char* name : {"100.21.bin", "100.58.bin"}) {
        data.put(std::string("scans/") + name, floats({1, 2, 3, 4}));
    }
    data.put("traj.txt", tum_rows(5, 100.0));
    Recording recording = open();
    EXPECT_EQ(recording.info().T_world_sensor[0].translation().x(), 1.0);
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 3.0);
    EXPECT_DOUBLE_EQ(recording.info().stamps[1], 100.58);
    EXPECT_TRUE(has_note(recording, "by time (file names)"));
    data.put("traj.txt", tum_rows(3, 100.0));
    EXPECT_HAS(open_error(), "100.58.bin");
}

TEST_F(MatchingTest, NanosecondsInFileNames) {
    for (const char* name : {"1500000000200000000.bin", "1500000000600000000.bin"}) {
        data.put(std::string("scans/") + name, floats({1, 2, 3, 4}));
    }
    data.put("traj.txt", tum_rows(5, 1.5e9));
    EXPECT_EQ(open().info().T_world_sensor[1].translation().x(), 3.0);
}

TEST_F(MatchingTest, SecondsAndNanosecondsInFileNames) {
    for (const char* name : {"cloud_1500000000_020000000.bin", "cloud_1500000000_620000000.bin"}) {
        data.put(std::string("scans/") + name, floats({1, 2, 3, 4}));
    }
    data.put("traj.txt", tum_rows(5, 1.5e9));
    const Recording recording = open();
    EXPECT_EQ(recording.info().T_world_sensor[0].translation().x(), 0.0);
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 3.0);
    EXPECT_NEAR(recording.info().stamps[1] - recording.info().stamps[0], 0.6, 1e-6);
    // Other numbers behind an underscore are no times.
    for (const char* name :
         {"cloud_12_020000000", "cloud_1500000000_02", "a_b_020000000", "_020000000"}) {
        const test::TemporaryFolder folder;
        folder.put(std::string(name) + ".bin", floats({1, 2, 3, 4}));
        EXPECT_FALSE(open_recording(folder.path()).info().measured_stamps) << name;
    }
}

TEST_F(MatchingTest, StampsOfBothSidesAreKeptWhereOrderDecides) {
    put_bins("scans", 3);
    data.put("traj.txt", tum_rows(3, 100.0));
    EXPECT_TRUE(open().info().pose_stamps.empty()) << "the scans have none of their own";
    data.put("times.txt", "0.2\n0.8\n1.2\n");
    OpenOptions from_one;
    from_one.first = 1;
    const Recording recording = open(from_one);
    EXPECT_EQ(recording.info().stamps, (std::vector<double>{0.8, 1.2}));
    ASSERT_EQ(recording.info().pose_stamps.size(), 2U);
    EXPECT_DOUBLE_EQ(recording.info().pose_stamps[0], 100.2);
}

TEST_F(MatchingTest, AUnitOfTimeIsThatOfThePosesTooUnlessTheyAreInSeconds) {
    put_bins("scans", 3);
    data.put("times.txt", "200\n600\n1000\n");
    OpenOptions milliseconds;
    milliseconds.time_unit = 1e-3;
    for (const char* poses : {"200 0 0 0 0 0 0 1\n600 1 0 0 0 0 0 1\n1000 2 0 0 0 0 0 1\n",
                              "0.2 0 0 0 0 0 0 1\n0.6 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n"}) {
        data.put("traj.txt", poses);
        const Recording recording = open(milliseconds);
        ASSERT_EQ(recording.info().pose_stamps.size(), 3U);
        EXPECT_DOUBLE_EQ(recording.info().stamps[2], 1.0);
        EXPECT_DOUBLE_EQ(recording.info().pose_stamps[2], 1.0) << poses;
    }
}

TEST_F(MatchingTest, TimesFile) {
    put_bins("scans", 2);
    data.put("times.txt", "0.2\n0.8\n");
    data.put("traj.txt", tum_rows(5));
    const Recording recording = open();
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 4.0);
    EXPECT_TRUE(has_note(recording, "times.txt"));
}

}  // namespace matching_test
}  // namespace dynamic_filter::io
