// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace glim_test {

using Glim = RecordingFiles;

TEST_F(Glim, SubmapsAreScans) {
    const auto submap = [](const std::string& x) {
        return "id: 0\nT_world_origin: \n1 0 0 " + x +
               "\n0 1 0 0\n0 0 1 0\n0 0 0 1\nnum_frames: 3\nframe_0\nstamp: " + x +
               "\nstamp: " + x + ".5\nstamp: " + x + ".75\n";
    };
    data.put("traj_lidar.txt", tum_rows(9));
    data.put("000000/data.txt", submap("1"));
    data.put("000000/points_compact.bin", floats({1, 2, 3, 4, 5, 6}));
    data.put("000001/data.txt", submap("2"));
    data.put("000001/points_compact.bin", floats({1, 2, 3}));
    data.put("000001/intensities_compact.bin", floats({0.5F}));
    const Recording recording = open();
    ASSERT_EQ(recording.size(), 2U);
    EXPECT_EQ(stem(recording, 1), "000001");
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 2.0);
    EXPECT_EQ(recording.info().stamps, (std::vector<double>{1.5, 2.5}));
    EXPECT_EQ(recording.read(0).points, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(column(recording.read(1).cloud, "intensity"), std::vector<double>{0.5});
    data.put("000001/intensities_compact.bin", floats({0.5F, 1}));
    EXPECT_HAS(error_of([&] { (void)recording.read(1); }), "8 bytes");
    data.put("000000/points_compact.bin", "truncated");
    EXPECT_HAS(error_of([&] { (void)recording.read(0); }), "multiple of 12");
    data.put("000000/data.txt", "id: 0\nT_world_origin: \n1 0 0 0\n");
    EXPECT_HAS(open_error(), "1 rows");
    data.put("000000/data.txt", "id: 0\nstamp: 1\n");
    EXPECT_HAS(open_error(), "no T_world_origin");
    data.put("000000/data.txt", "stamp: soon\n");
    EXPECT_HAS(open_error(), "no stamp");
}

}  // namespace glim_test
}  // namespace dynamic_filter::io
