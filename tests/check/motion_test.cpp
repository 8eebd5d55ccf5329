// SPDX-License-Identifier: MIT
#include "check/motion.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::app {
namespace motion_of_recording_test {

using TrackStatus = dynamic_filter::TrackStatus;

class UseTrack : public io::RecordingFiles {
protected:
    static constexpr std::size_t kScans = 10;
    /// Scans 1 m apart; the first `count` of them have this status.
    static std::vector<std::optional<Tracked>> tracked(TrackStatus status, std::size_t count) {
        std::vector<std::optional<Tracked>> result(kScans);
        for (std::size_t i = 0; i < kScans; ++i) {
            Tracked t;
            t.T_world_sensor = Pose(Eigen::Translation3d(static_cast<double>(i), 0.0, 0.0));
            if (i < count) t.status = status;
            result[i] = t;
        }
        return result;
    }
    [[nodiscard]] io::Recording placed(TrackStatus status, std::size_t count) const {
        io::Recording recording = open();
        said_ = use_track(recording, tracked(status, count));
        return recording;
    }
    void SetUp() override { put_bins("velodyne", kScans); }
    mutable std::string said_;
};

TEST_F(UseTrack, GivesTheRecordingItsPosesAndSaysHowFarTheyGo) {
    const io::Recording recording = placed(TrackStatus::good, kScans);
    EXPECT_TRUE(recording.info().has_poses);
    EXPECT_EQ(recording.info().T_world_sensor[3].translation().x(), 3.0);
    EXPECT_EQ(said_, "the odometry went 9.0 m");
    EXPECT_TRUE(recording.info().losses.empty());
}

TEST_F(UseTrack, LostScansAreALoss) {
    const io::Recording recording = placed(TrackStatus::lost, 2);
    ASSERT_EQ(recording.info().losses.size(), 1U);
    EXPECT_HAS(recording.info().losses[0], "2 scans do not fit those before them");
}

TEST_F(UseTrack, MotionThatManyScansDoNotShowIsALoss) {
    EXPECT_TRUE(placed(TrackStatus::weak, 5).info().losses.empty());
    const io::Recording recording = placed(TrackStatus::weak, 6);
    ASSERT_EQ(recording.info().losses.size(), 1U);
    EXPECT_HAS(recording.info().losses[0], "6 of 10 scans do not show how far the sensor went");
}

TEST_F(UseTrack, GivenPosesBindScansThatDoNotShowTheirMotion) {
    data.put("poses.txt", kitti_rows(kScans));
    EXPECT_TRUE(placed(TrackStatus::weak, kScans).info().losses.empty());
}

}  // namespace motion_of_recording_test
}  // namespace dynamic_filter::app
