// SPDX-License-Identifier: MIT
#include "recording/matching.hpp"

#include "support/pillars.hpp"
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
    // Interpolated: one pose in 0.2 s.
    EXPECT_NEAR(recording.info().T_world_sensor[0].translation().x(), 1.05, 1e-6);
    EXPECT_NEAR(recording.info().T_world_sensor[1].translation().x(), 2.9, 1e-6);
    EXPECT_DOUBLE_EQ(recording.info().stamps[1], 100.58);
    EXPECT_TRUE(has_note(recording, "by time (file names)"));
    data.put("traj.txt", tum_rows(3, 100.0));
    recording = open();
    EXPECT_TRUE(has_note(recording, "1 scan has no pose"));
    EXPECT_FALSE(recording.info().T_world_sensor[1].matrix().allFinite());
    data.put("traj.txt", tum_rows(3, 200.0));
    EXPECT_HAS(open_error(), "100.21.bin");
    EXPECT_HAS(open_error(), "no scan has a pose");
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
    EXPECT_NEAR(recording.info().T_world_sensor[0].translation().x(), 0.1, 1e-5);
    EXPECT_NEAR(recording.info().T_world_sensor[1].translation().x(), 3.1, 1e-5);
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
    data.put("times.txt", "0.2\n0.4\n0.6\n");  // of another clock
    OpenOptions from_one;
    from_one.first = 1;
    const Recording recording = open(from_one);
    EXPECT_EQ(recording.info().stamps, (std::vector<double>{0.4, 0.6}));
    ASSERT_EQ(recording.info().pose_stamps.size(), 2U);
    EXPECT_DOUBLE_EQ(recording.info().pose_stamps[0], 100.2);
}

// As many poses as scans, but shifted by whole scans: each scan has the pose of its time or none.
TEST_F(MatchingTest, TimeDecidesWhereBothSidesHaveStamps) {
    const std::size_t count = 8;
    put_bins("scans", count);
    for (const double first : {0.0, 50.0, 1.7e9}) {
        std::string times;
        for (std::size_t i = 0; i < count; ++i) {
            times += std::to_string(first + 0.2 * static_cast<double>(i)) + "\n";
        }
        data.put("times.txt", times);
        for (const int shift : {-3, -1, 0, 1, 3}) {
            if (first == 0.0 && std::abs(shift) > 1) continue;  // may be a clock of its own
            data.put("traj.txt", tum_rows(count, first + 0.2 * shift));
            const Recording recording = open();
            for (int i = 0; i < static_cast<int>(count); ++i) {
                const Pose& pose = recording.info().T_world_sensor[static_cast<std::size_t>(i)];
                const int row = i - shift;
                const bool is_known = row >= 0 && row < static_cast<int>(count);
                ASSERT_EQ(pose.matrix().allFinite(), is_known) << first << " " << shift << " " << i;
                if (!is_known) continue;
                EXPECT_NEAR(pose.translation().x(), row, 1e-6);
            }
            EXPECT_FALSE(recording.info().sparse_poses);
            const bool is_said =
                has_note(recording, "the poses begin") &&
                has_note(recording, shift < 0 ? "before the scans" : "after the scans");
            EXPECT_EQ(is_said, shift != 0);
        }
    }
}

TEST_F(MatchingTest, AClockThatBeginsAtZeroIsAnotherOne) {
    put_bins("scans", 8);
    data.put("times.txt", "0\n0.2\n0.4\n0.6\n0.8\n1\n1.2\n1.4\n");
    data.put("traj.txt", tum_rows(8, 1.2));
    const Recording recording = open();
    EXPECT_TRUE(has_note(recording, "by order"));
    EXPECT_EQ(recording.info().T_world_sensor[7].translation().x(), 7.0);
    EXPECT_EQ(recording.info().pose_stamps.size(), 8U);
}

TEST_F(MatchingTest, StampsThatRepeatTellNoOrder) {
    put_bins("scans", 6);
    for (const char* times : {"10\n10\n10\n10\n10\n11\n", "10\n10\n10\n10\n10\n10\n"}) {
        data.put("times.txt", times);
        data.put("traj.txt", tum_rows(6, 10.0));
        const Recording recording = open();
        EXPECT_TRUE(has_note(recording, "by order"));
        EXPECT_EQ(recording.info().T_world_sensor[3].translation().x(), 3.0);
    }
}

TEST_F(MatchingTest, RoundedStampsOfPosesAreNamed) {
    for (const char* name : {"1700000000.2.bin", "1700000000.4.bin"}) {
        data.put(std::string("scans/") + name, floats({1, 2, 3, 4}));
    }
    data.put("poses.csv",
             "#timestamp [ns],x,y,z,qw,qx,qy,qz\n1.700000e+18,0,0,0,1,0,0,0\n"
             "1.700000e+18,1,0,0,1,0,0,0\n1.700000e+18,2,0,0,1,0,0,0\n");
    const std::string error = open_error();
    EXPECT_HAS(error, "stamps are rounded: 2 of 3 rows");
    EXPECT_HAS(error, "--poses none");
}

TEST_F(MatchingTest, RowsOfLostTrackingStayLost) {
    put_bins("scans", 4);
    data.put("times.txt", "10\n10.2\n10.4\n10.6\n");
    data.put("traj.txt",
             "10 0 0 0 0 0 0 1\n10.2 nan 0 0 0 0 0 1\n10.4 2 0 0 0 0 0 1\n"
             "10.6 3 0 0 0 0 0 1\n10.8 4 0 0 0 0 0 1\n");
    const Recording recording = open();
    EXPECT_FALSE(recording.info().T_world_sensor[1].matrix().allFinite());
    EXPECT_EQ(recording.info().T_world_sensor[2].translation().x(), 2.0);
    EXPECT_EQ(recording.info().trajectory.stamps.size(), 4U);
    EXPECT_FALSE(recording.info().sparse_poses);
}

TEST_F(MatchingTest, SparsePosesLeaveScansToTheOdometry) {
    put_bins("scans", 31);
    std::string times;
    for (int i = 0; i < 31; ++i) times += std::to_string(100.0 + 0.1 * i) + "\n";
    data.put("times.txt", times);
    data.put("traj.txt", tum_rows(4, 100.0, 1.0));
    const Recording recording = open();
    EXPECT_TRUE(recording.info().sparse_poses);
    EXPECT_EQ(recording.info().trajectory.stamps.size(), 4U);
    EXPECT_TRUE(has_note(recording, "poses at 1 of 10 scans"));
    for (std::size_t i = 0; i < 31; ++i) {
        EXPECT_EQ(recording.info().T_world_sensor[i].matrix().allFinite(), i % 10 == 0) << i;
    }
    EXPECT_EQ(recording.read(10).T_world_sensor.translation().x(), 1.0);
    EXPECT_THROW((void)recording.read(11), InputError);
    EXPECT_FALSE(slice(recording, 0, {}, 10).info().sparse_poses) << "all of these have poses";
    EXPECT_TRUE(slice(recording, 5).info().sparse_poses);
    EXPECT_FALSE(without_poses(recording).info().sparse_poses);
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
        EXPECT_TRUE(has_note(recording, "by time")) << poses;
        EXPECT_DOUBLE_EQ(recording.info().stamps[2], 1.0);
        EXPECT_DOUBLE_EQ(recording.info().trajectory.stamps[2], 1.0) << poses;
        EXPECT_EQ(recording.info().T_world_sensor[2].translation().x(), 2.0);
    }
}

TEST_F(MatchingTest, AUnitOfTimeIsThatOfTheNamesToo) {
    for (const char* name : {"34567000000.bin", "34567100000.bin", "34567200000.bin"}) {
        data.put(std::string("scans/") + name, floats({1, 2, 3, 4}));
    }
    data.put("traj.txt",
             "34567000000 0 0 0 0 0 0 1\n34567100000 1 0 0 0 0 0 1\n"
             "34567200000 2 0 0 0 0 0 1\n");
    OpenOptions microseconds;
    microseconds.time_unit = 1e-6;
    const Recording recording = open(microseconds);
    EXPECT_DOUBLE_EQ(recording.info().stamps[1], 34567.1);
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 1.0);
}

TEST_F(MatchingTest, PosesInAnotherUnitThatOrderCannotMatch) {
    put_bins("scans", 3);
    data.put("times.txt", "1700000000.2\n1700000000.6\n1700000001\n");
    std::string rows;
    for (int i = 0; i < 5; ++i) {
        rows +=
            std::to_string(1700000000200 + 200 * i) + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
    }
    data.put("traj.txt", rows);
    const Recording recording = open();
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 2.0);
    EXPECT_EQ(unit_between({0, 1000}, {0, 1}), 1e-3);
    EXPECT_EQ(unit_between({0, 500, 1000}, {0, 1}), 1.0) << "poses of a longer drive";
    EXPECT_EQ(unit_between({}, {0, 1}), 1.0);
}

TEST_F(MatchingTest, NamesThatAreTheNumbersOfTheRows) {
    for (const std::size_t i : {0, 1, 3, 6}) {
        data.put("velodyne/" + number(i) + ".bin", floats({1, 2, 3, 0.5F}));
    }
    data.put("poses.txt", kitti_rows(7));
    data.put("times.txt", "0\n0.1\n0.2\n0.3\n0.4\n0.5\n0.6\n");
    const Recording recording = open();
    EXPECT_EQ(recording.info().T_world_sensor[2].translation().x(), 3.0);
    EXPECT_EQ(recording.info().T_world_sensor[3].translation().x(), 6.0);
    EXPECT_EQ(recording.info().stamps, (std::vector<double>{0.0, 0.1, 0.3, 0.6}));
    EXPECT_TRUE(has_note(recording, "by the numbers of their names"));
    EXPECT_EQ(rows_in_names({"1.bin", "3.bin", "5.bin"}, 5), (std::vector<std::size_t>{0, 2, 4}));
    EXPECT_EQ(rows_in_names({"1.bin", "3.bin", "5.bin"}, 6), (std::vector<std::size_t>{1, 3, 5}));
    EXPECT_TRUE(rows_in_names({"0.bin", "1.bin", "2.bin"}, 4).empty()) << "is a row too many?";
    EXPECT_TRUE(rows_in_names({"a.bin", "3.bin"}, 4).empty());
    EXPECT_EQ(rows_in_names({"0.bin", "2.bin"}, 9), (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(rows_in_names({"5.bin", "6.bin"}, 9), (std::vector<std::size_t>{5, 6}));
    EXPECT_TRUE(rows_in_names({"1.bin", "2.bin"}, 9).empty()) << "numbered anew?";
    EXPECT_TRUE(rows_in_names({"0.bin", "12.bin"}, 9).empty());
}

/// KITTI's rows of the curve from one scan to another.
std::string rows_of_curve(int first, int last) {
    std::string text;
    for (int scan = first; scan < last; ++scan) {
        // It bends more and more, so that no two parts of it are alike.
        const Pose pose = on_a_curve(0.02 * scan * scan);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                text += std::to_string(pose(row, column)) + (row * column == 6 ? "\n" : " ");
            }
        }
    }
    return text;
}

TEST_F(MatchingTest, MorePosesThanScansWithoutGapsAreMatchedByTheScans) {
    for (int scan = 20; scan < 50; ++scan) {
        write_pcd(data / (number(static_cast<std::size_t>(scan - 20)) + ".pcd"),
                  pillars_seen_from(on_a_curve(0.02 * scan * scan)));
    }
    data.put("poses.txt", rows_of_curve(20, 70));
    const Recording first = open();
    EXPECT_TRUE(has_note(first, "30 scans but 50 poses, and names without gaps: the first rows"));
    EXPECT_NEAR(first.info().T_world_sensor[3].translation().x(),
                on_a_curve(0.02 * 23 * 23).translation().x(), 1e-5);
    data.put("poses.txt", rows_of_curve(0, 50));
    const Recording last = open();
    EXPECT_TRUE(has_note(last, "the last rows"));
    EXPECT_NEAR(last.info().T_world_sensor[3].translation().x(),
                on_a_curve(0.02 * 23 * 23).translation().x(), 1e-5);
    data.put("poses.txt", rows_of_curve(10, 60));
    EXPECT_HAS(open_error(), "30 scans in");
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
