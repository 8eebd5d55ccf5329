// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace hdl_test {

class Hdl : public RecordingFiles {
protected:
    static std::string matrix(double x) {
        return "1 0 0 " + std::to_string(x) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    }
    void put_keyframe(const std::string& name, const std::string& text) const {
        put_pcd(name + "/cloud.pcd", 0.0, 0.5F);
        data.put(name + "/data", text);
    }
};

TEST_F(Hdl, EstimatesArePosesAndOdometryWhereThereIsNone) {
    put_keyframe("000000", "stamp 7 250000000\nestimate\n" + matrix(3) + "odom\n" + matrix(5));
    put_keyframe("000001", "stamp 8 0\nodom\n" + matrix(6) + "id 1\n");
    data.put("graph.g2o", "");
    const Recording recording = open();
    EXPECT_EQ(recording.info().layout, "hdl");
    ASSERT_EQ(recording.size(), 2U);
    EXPECT_EQ(stem(recording, 1), "000001");
    EXPECT_EQ(recording.info().stamps, (std::vector<double>{7.25, 8.0}));
    EXPECT_EQ(recording.info().T_world_sensor[0].translation().x(), 3.0);
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 6.0);
    EXPECT_EQ(recording.read(0).points, (Points{{10, 0, 0}, {0, 5, 0}}));
    EXPECT_TRUE(has_note(recording, "1 of `estimate`, 1 of `odom`"));
}

TEST_F(Hdl, FaultsAreNamed) {
    put_keyframe("000000", "stamp 7 0\nid 1\n");
    EXPECT_HAS(open_error(), "neither 'estimate' nor 'odom'");
    put_keyframe("000000", "stamp 7\nodom\n" + matrix(6));
    EXPECT_HAS(open_error(), "seconds and nanoseconds");
    put_keyframe("000000", "odom\n1 0 0 0\n");
    EXPECT_HAS(open_error(), "1 rows");
    put_keyframe("000000", "odom\n" + matrix(6));
    EXPECT_FALSE(open().info().measured_stamps);
    data.put("000000/cloud.pcd", "no PCD");
    EXPECT_HAS(error_of([&] { (void)open().read(0); }), "'no'");
}

}  // namespace hdl_test
}  // namespace dynamic_filter::io
