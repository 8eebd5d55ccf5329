// SPDX-License-Identifier: MIT
#include "run/open_for_result.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "recording/scans.hpp"
#include "run/placed.hpp"
#include "support/recording.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace open_for_result_test {

namespace fs = std::filesystem;

double x_of(const io::Recording& recording, std::size_t i) {
    return recording.read(i).T_world_sensor.translation().x();
}

/// Twenty scans at x = 0, 1, ... m; a run with `how` found that they are at 100, 101, ...
class OpenForResult : public io::RecordingFiles {
protected:
    void SetUp() override {
        put_bins("velodyne", 20);
        data.put("poses.txt", kitti_rows(20));
    }
    void leave_result(const DataOptions& how = {}, double moved = 100.0) const {
        DataOptions options = how;
        options.data = data.path();
        const io::Recording recording = app::open(options);
        std::vector<std::optional<Tracked>> tracked(recording.size());
        for (std::size_t i = 0; i < recording.size(); ++i) {
            tracked[i].emplace();
            tracked[i]->T_world_sensor.translation().x() =
                moved + static_cast<double>(how.first + i * how.stride);
        }
        write_placed(result_.path(),
                     placed_of(io::with_poses(recording, tracked), how, fingerprint_of(recording)));
    }
    [[nodiscard]] RecordingOfResult opened(DataOptions asked = {}) const {
        if (asked.data.empty()) asked.data = data.path();
        return open_for_result(asked, result_.path());
    }
    test::TemporaryFolder result_;
};

TEST_F(OpenForResult, BringsThePosesOfTheRun) {
    leave_result();
    fs::create_directories(result_ / "labels");
    test::spill(result_ / "static_map.pcd", "");
    for (const fs::path& given : {result_.path(), result_ / "", result_ / "labels",
                                  result_ / "labels/", result_ / "static_map.pcd"}) {
        const RecordingOfResult found = open_for_result({.data = data.path()}, given);
        ASSERT_EQ(found.recording.size(), 20U) << given;
        EXPECT_EQ(x_of(found.recording, 7), 107.0) << given;
        EXPECT_NE(found.note.find("the poses that it found or refined"), std::string::npos);
    }
}

TEST_F(OpenForResult, FindsARecordingThatWasMoved) {
    leave_result();
    const test::TemporaryFolder elsewhere;
    fs::copy(data.path(), elsewhere / "moved", fs::copy_options::recursive);
    EXPECT_EQ(x_of(opened({.data = elsewhere / "moved"}).recording, 7), 107.0);
}

TEST_F(OpenForResult, AnotherRecordingKeepsItsPosesAndThatIsSaid) {
    leave_result();
    data.put("poses.txt", kitti_rows(1) + kitti_rows(19));
    const RecordingOfResult found = opened();
    EXPECT_EQ(x_of(found.recording, 7), 6.0);
    EXPECT_NE(found.note.find("is not the recording of the run"), std::string::npos) << found.note;
}

TEST_F(OpenForResult, ARecordingWithoutPosesGetsThoseOfTheRun) {
    leave_result();
    fs::remove(data / "poses.txt");
    EXPECT_EQ(x_of(opened().recording, 7), 107.0);
    fs::remove(data / "velodyne/000019.bin");
    EXPECT_THROW((void)opened(), InputError);
}

TEST_F(OpenForResult, OptionsThatAreGivenGoBefore) {
    leave_result({.data = {}, .poses = kNoPoses});
    data.put("others.txt", kitti_rows(3) + kitti_rows(17));
    EXPECT_EQ(x_of(opened({.data = {}, .poses = data / "others.txt"}).recording, 7), 4.0);
    EXPECT_EQ(x_of(opened({.data = {}, .pose_fix = "inverse"}).recording, 7), -7.0);
    EXPECT_EQ(x_of(opened({.data = {}, .poses = kNoPoses}).recording, 7), 107.0);
    EXPECT_EQ(x_of(opened().recording, 7), 107.0);
}

TEST_F(OpenForResult, TheRecordingIsReadAsByTheRun) {
    const io::Recording recording = app::open({.data = data.path(), .pose_fix = "inverse"});
    write_placed(result_.path(), placed_of(recording, {.data = {}, .pose_fix = "inverse"},
                                           fingerprint_of(recording)));
    EXPECT_EQ(x_of(opened().recording, 7), -7.0);
    EXPECT_NE(opened().note.find("--pose-fix inverse"), std::string::npos) << opened().note;
}

TEST_F(OpenForResult, NothingIsSaidIfNothingDiffers) {
    const io::Recording recording = app::open({.data = data.path()});
    write_placed(result_.path(), placed_of(recording, {}, fingerprint_of(recording)));
    EXPECT_EQ(opened().note, "");
    EXPECT_EQ(x_of(opened().recording, 7), 7.0);
}

// Every selection of the run, and every one that is asked for: scans have the poses of their own
// rows.
TEST_F(OpenForResult, SelectionsMeet) {
    for (const DataOptions& how : {DataOptions{}, DataOptions{.data = {}, .first = 4},
                                   DataOptions{.data = {}, .first = 3, .last = 17, .stride = 2}}) {
        leave_result(how);
        EXPECT_EQ(x_of(opened().recording, 1), 100.0 + static_cast<double>(how.first + how.stride));
        for (const std::size_t first : {0, 5, 9}) {
            for (const std::size_t stride : {1, 2, 3}) {
                if (first == 0 && stride == 1) continue;
                std::vector<std::size_t> expected;
                for (std::size_t i = first; i <= 15; i += stride) {
                    const bool in_run = i >= how.first && i <= how.last.value_or(19) &&
                                        (i - how.first) % how.stride == 0;
                    if (in_run) expected.push_back(i);
                }
                if (expected.empty()) {
                    EXPECT_THROW(
                        (void)opened({.data = {}, .first = first, .last = 15, .stride = stride}),
                        ConfigError);
                    continue;
                }
                const io::Recording found =
                    opened({.data = {}, .first = first, .last = 15, .stride = stride}).recording;
                ASSERT_EQ(found.size(), expected.size());
                for (std::size_t k = 0; k < expected.size(); ++k) {
                    EXPECT_EQ(io::stem(found, k), number(expected[k]));
                    EXPECT_EQ(x_of(found, k), 100.0 + static_cast<double>(expected[k]));
                }
            }
        }
    }
    EXPECT_THROW((void)opened({.data = {}, .first = 18}), ConfigError);
}

TEST_F(OpenForResult, PosesBesideForeignLabelsServeWhereThereAreNone) {
    test::spill(result_ / "poses.txt", kitti_rows(2) + kitti_rows(18));
    EXPECT_EQ(x_of(opened().recording, 7), 7.0);
    fs::remove(data / "poses.txt");
    const RecordingOfResult found = opened();
    EXPECT_EQ(x_of(found.recording, 7), 5.0);
    EXPECT_NE(found.note.find("poses.txt"), std::string::npos);
}

}  // namespace open_for_result_test
}  // namespace dynamic_filter::app
