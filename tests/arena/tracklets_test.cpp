// SPDX-License-Identifier: MIT
#include "arena/tracklets.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace tracklets_test {

std::string pose_item(double x, double y, double yaw = 0.0) {
    return "<item><tx>" + std::to_string(x) + "</tx><ty>" + std::to_string(y) +
           "</ty><tz>-1.6</tz><rx>0</rx><ry>0</ry><rz>" + std::to_string(yaw) + "</rz></item>";
}

/// A car of 4 x 2 x 1.5 m from scan 3 on.
std::string file_of(const std::string& poses) {
    return "<?xml version=\"1.0\"?><!DOCTYPE boost_serialization><boost_serialization>"
           "<tracklets><count>1</count><item_version>1</item_version><item><objectType>Car"
           "</objectType><h>1.5</h><w>2</w><l>4</l><first_frame>3</first_frame><poses><count>2"
           "</count>" +
           poses + "</poses><finished>1</finished></item></tracklets></boost_serialization>";
}

class Tracklets : public testing::Test {
protected:
    std::vector<Tracklet> read(const std::string& text) {
        io::write_file(file_, text);
        return read_tracklets(file_);
    }
    std::string error_of(const std::string& text) {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "tracklet_labels.xml";
};

TEST_F(Tracklets, AreReadWithTheirSizeAndPoses) {
    const auto tracks = read(file_of(pose_item(10, 2) + pose_item(11, 2, 0.5)));
    ASSERT_EQ(tracks.size(), 1U);
    EXPECT_EQ(tracks[0].type, "Car");
    EXPECT_EQ(tracks[0].size, Eigen::Vector3d(4.0, 2.0, 1.5));
    EXPECT_EQ(tracks[0].first_scan, 3U);
    ASSERT_EQ(tracks[0].T_sensor_box.size(), 2U);
    EXPECT_NEAR(tracks[0].T_sensor_box[1].linear()(1, 0), std::sin(0.5), 1e-9);
}

TEST_F(Tracklets, OtherFilesAreRefusedWithTheLine) {
    EXPECT_NE(error_of("no xml").find("tracklet"), std::string::npos);
    EXPECT_NE(error_of("<a></a>").find("boost_serialization"), std::string::npos);
    EXPECT_NE(error_of(file_of("<item><tx>1</tx></item>")).find("<item> has no <ty>"),
              std::string::npos);
    EXPECT_NE(error_of(file_of("<item><tx>one</tx></item>")).find("(line 1): <tx> is no number"),
              std::string::npos);
}

TEST_F(Tracklets, MotionIsThatInTheWorldNotThatBeforeTheSensor) {
    const auto tracks = read(file_of(pose_item(10, 2) + pose_item(8, 2)));
    std::vector<Pose> poses(5, Pose::Identity());
    EXPECT_EQ(motion_of(tracks[0], poses), Label::dynamic);  // the sensor rests, the car comes
    poses[4].translation().x() = 2.0;                        // the sensor goes by a parked car
    EXPECT_EQ(motion_of(tracks[0], poses), Label::static_);
    poses[4].translation().x() = 1.0;
    EXPECT_EQ(motion_of(tracks[0], poses), Label::unknown);
}

TEST_F(Tracklets, PointsAreKnownWhereSomebodyLooked) {
    const auto tracks = read(file_of(pose_item(10, 0) + pose_item(12, 0)));
    const Points points = {{10.0F, 0.0F, -1.0F},   // in the box
                           {10.0F, 0.0F, -1.5F},   // the ground below it
                           {10.0F, 1.1F, -1.0F},   // its rim
                           {10.0F, 1.3F, -1.0F},   // beside it
                           {2.0F, 0.0F, -1.0F},    // too near
                           {70.0F, 0.0F, -1.0F},   // too far
                           {-10.0F, 0.0F, -1.0F},  // behind the sensor, where nobody drew boxes
                           {0.0F, 0.0F, 0.0F}};    // no return
    using enum Label;
    const Labels moving = truth_by_tracklets(tracks, {dynamic}, 3, points);
    EXPECT_EQ(moving,
              (Labels{dynamic, unknown, unknown, static_, unknown, unknown, unknown, unknown}));
    const Labels resting = truth_by_tracklets(tracks, {static_}, 3, points);
    EXPECT_EQ(resting,
              (Labels{static_, static_, static_, static_, unknown, unknown, unknown, unknown}));
    const Labels maybe = truth_by_tracklets(tracks, {unknown}, 3, points);
    EXPECT_EQ(maybe[0], unknown);
    EXPECT_EQ(maybe[3], static_);
    EXPECT_EQ(truth_by_tracklets(tracks, {dynamic}, 2, points)[0], static_);  // before it came
    EXPECT_EQ(truth_by_tracklets(tracks, {dynamic}, 5, points)[0], static_);  // after it left
}

}  // namespace tracklets_test
}  // namespace dynamic_filter::app
