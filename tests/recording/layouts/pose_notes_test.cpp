// SPDX-License-Identifier: MIT
#include "recording/layouts/pose_notes.hpp"

#include "formats/poses/rigid.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace pose_notes_test {

using PoseNotes = RecordingFiles;

TEST_F(PoseNotes, FilesWithAsManyRowsAsScansAreOffered) {
    const auto fits = data.put("gt.txt", "# x y\n" + kitti_rows(3));
    data.put("short.txt", kitti_rows(2));
    data.put("words.txt", "a b c d e f g\na b c d e f g\na b c d e f g\n");
    data.put("narrow.csv", "1,2,3\n1,2,3\n1,2,3\n");
    EXPECT_EQ(offer_poses(3, {data.path()}), "; try --poses " + fits.string());
    const std::string row = "1,2,3,4,5,6,7,8\n";
    const auto table = data.put("above/gt.csv", "t,x,y,z,a,b,c,d\n" + row + row + row);
    EXPECT_EQ(offer_poses(3, {data.path(), data / "above"}),
              "; try --poses " + fits.string() + " or --poses " + table.string());
    EXPECT_EQ(offer_poses(7, {data.path(), data / "none"}), "");
}

TEST_F(PoseNotes, FilesOfAUsualNameAreOfferedWhateverTheirLength) {
    const auto usual = data.put("poses.txt", kitti_rows(9));
    EXPECT_EQ(offer_poses(3, {data.path()}), "; try --poses " + usual.string());
}

TEST_F(PoseNotes, AFolderOfManyTextFilesHoldsNoPoses) {
    for (int i = 0; i < 101; ++i) data.put(std::to_string(i) + ".txt", kitti_rows(1));
    EXPECT_EQ(offer_poses(1, {data.path()}), "");
}

TEST_F(PoseNotes, LostPosesAreCounted) {
    Layout layout;
    layout.T_world_sensor = {Pose::Identity(), lost_pose(), lost_pose()};
    note_lost(layout);
    EXPECT_EQ(layout.notes, std::vector<std::string>{"2 of 3 scans have no pose"});
    layout.T_world_sensor = {Pose::Identity()};
    note_lost(layout);
    EXPECT_EQ(layout.notes.size(), 1U);
}

}  // namespace pose_notes_test
}  // namespace dynamic_filter::io
