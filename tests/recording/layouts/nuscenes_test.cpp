// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace nuscenes_test {

std::string entry(const std::string& token, const std::string& rest) {
    return R"({"token": ")" + token + "\", " + rest + "}";
}

std::string pose_entry(const std::string& token, const std::string& x, const std::string& q) {
    return entry(token, "\"translation\": [" + x + ", 0, 0], \"rotation\": [" + q + "]");
}

std::string sweep(const std::string& file, const std::string& time, const std::string& sample,
                  const std::string& ego) {
    return entry(file, R"("filename": ")" + file + R"(", "timestamp": )" + time +
                           R"(, "sample_token": ")" + sample + R"(", "ego_pose_token": ")" + ego +
                           R"(", "calibrated_sensor_token": "top")");
}

class Nuscenes : public RecordingFiles {
protected:
    void SetUp() override {
        table("scene", entry("s1", R"("name": "scene-0001")") + "," +
                           entry("s2", R"("name": "scene-0002")"));
        table("sample",
              entry("k1", R"("scene_token": "s1")") + "," + entry("k2", R"("scene_token": "s2")"));
        table("sample_data", sweep("sweeps/LIDAR_TOP/a__2.pcd.bin", "1500000", "k1", "e2") + "," +
                                 sweep("samples/LIDAR_TOP/b__1.pcd.bin", "1000000", "k1", "e1") +
                                 "," + sweep("samples/CAM_FRONT/c.jpg", "1000000", "k1", "e1") +
                                 "," + sweep("samples/LIDAR_TOP/d.pcd.bin", "1000000", "k2", "e1"));
        table("ego_pose", pose_entry("e1", "1", "1, 0, 0, 0") + "," +
                              pose_entry("e2", "2", "0, 0, 0, 1") + "," +
                              pose_entry("unused", "2", "0, 0, 0, 0"));
        table("calibrated_sensor", pose_entry("top", "0.5", "1, 0, 0, 0"));
        data.put("samples/LIDAR_TOP/b__1.pcd.bin", floats({1, 2, 3, 4, 5}));
        data.put("sweeps/LIDAR_TOP/a__2.pcd.bin", floats({1, 2, 3, 4, 5, 6}));
    }
    void table(const std::string& name, const std::string& entries) const {
        data.put("v1.0-mini/" + name + ".json", "[" + entries + "]");
    }
    [[nodiscard]] std::string scene_error() const {
        return error_of([&] { (void)open_recording(data / "scene-0001"); });
    }
};

TEST_F(Nuscenes, OneScene) {
    const Recording recording = open_recording(data / "scene-0001");
    ASSERT_EQ(recording.size(), 2U);
    EXPECT_EQ(recording.info().stamps, (std::vector<double>{1.0, 1.5}));
    EXPECT_DOUBLE_EQ(recording.info().T_world_sensor[0].translation().x(), 1.5);
    EXPECT_DOUBLE_EQ(recording.info().T_world_sensor[1].translation().x(),
                     1.5);  // half a turn about z
    const FullScan scan = recording.read(0);
    EXPECT_EQ(scan.points, (Points{{1, 2, 3}}));
    EXPECT_EQ(column(scan.cloud, "ring"), std::vector<double>{5});
    EXPECT_HAS(error_of([&] { (void)recording.read(1); }), "multiple of 20");
}

/// An annotated box around (1, 2, 3) of the sensor at the key frame; half a metre wide, long and
/// high.
std::string box(const std::string& sample, const std::string& instance,
                const std::string& attribute) {
    return entry("box", R"("sample_token": ")" + sample + R"(", "instance_token": ")" + instance +
                            R"(", "attribute_tokens": [)" + attribute +
                            R"(], "translation": [2.5, 2, 3], "rotation": [1, 0, 0, 0])" +
                            R"(, "size": [0.5, 0.5, 0.5])");
}

TEST_F(Nuscenes, KeyFramesHaveTruthByTheBoxesAndSweepsHaveNone) {
    data.put("samples/LIDAR_TOP/b__1.pcd.bin", floats({1, 2, 3, 4, 5, 9, 2, 3, 4, 5}));
    data.put("sweeps/LIDAR_TOP/a__2.pcd.bin", floats({1, 2, 3, 4, 5}));
    EXPECT_FALSE(open_recording(data / "scene-0001").info().has_truth());  // no annotations
    table("attribute", entry("m", R"("name": "vehicle.moving")"));
    table("sample_annotation", box("k1", "car", R"("m")"));
    const Recording recording = open_recording(data / "scene-0001");
    EXPECT_TRUE(has_note(recording, "ground truth of 1 key frames by the boxes of"));
    EXPECT_EQ(recording.read(0).truth, (Labels{Label::dynamic, Label::static_}));
    EXPECT_TRUE(recording.read(1).truth.empty());
    EXPECT_FALSE(recording.info().label_files[0].empty());
    EXPECT_TRUE(recording.info().label_files[1].empty());
    data.put("p.txt", kitti_rows(2));
    // Which scans are chosen, and whose poses they have, changes nothing in their truth.
    OpenOptions given;
    given.layout = "nuscenes";
    given.poses = data / "p.txt";
    given.last = 0;
    EXPECT_EQ(open_recording(data / "scene-0001", given).read(0).truth, recording.read(0).truth);
    EXPECT_TRUE(slice(recording, 1).read(0).truth.empty());
}

TEST_F(Nuscenes, SweepsThatAreNotOnTheDiskAreLeftOut) {
    EXPECT_FALSE(has_note(open_recording(data / "scene-0001"), "between key frames"));
    std::filesystem::remove(data / "sweeps/LIDAR_TOP/a__2.pcd.bin");
    const Recording recording = open_recording(data / "scene-0001");
    EXPECT_EQ(recording.info().stamps, std::vector<double>{1.0});
    EXPECT_TRUE(has_note(recording, "none of the 1 scans between key frames is in "));
    table("sample_data", sweep("sweeps/LIDAR_TOP/a__2.pcd.bin", "1500000", "k1", "e2") + "," +
                             sweep("sweeps/LIDAR_TOP/a__3.pcd.bin", "1600000", "k1", "e2") + "," +
                             sweep("samples/LIDAR_TOP/b__1.pcd.bin", "1000000", "k1", "e1"));
    data.put("sweeps/LIDAR_TOP/a__3.pcd.bin", floats({1, 2, 3, 4, 5}));
    EXPECT_EQ(open_recording(data / "scene-0001").size(), 2U);
    EXPECT_TRUE(has_note(open_recording(data / "scene-0001"),
                         "1 of the 2 scans between key frames are not in "));
    // A key frame that is missing is a fault.
    data.put("sweeps/LIDAR_TOP/a__2.pcd.bin", floats({1, 2, 3, 4, 5}));
    std::filesystem::remove(data / "samples/LIDAR_TOP/b__1.pcd.bin");
    EXPECT_EQ(open_recording(data / "scene-0001").size(), 3U);
    EXPECT_HAS(error_of([&] { (void)open_recording(data / "scene-0001").read(0); }), "b__1");
}

TEST_F(Nuscenes, Faults) {
    EXPECT_HAS(open_error(), "scene-0001, scene-0002");
    EXPECT_HAS(error_of([&] { (void)open_recording(data / "scene-9"); }),
               "has no scene-9; choose a scene");
    for (const char* given : {"v1.0-mini", "samples", "samples/LIDAR_TOP", "sweeps/LIDAR_TOP/"}) {
        EXPECT_HAS(error_of([&] { (void)open_recording(data / given); }),
                   (data / "scene-0061").string() + "; there are: scene-0001, scene-0002");
    }
    table("ego_pose", pose_entry("e1", "1", "1, 0, 0, 0"));
    EXPECT_HAS(scene_error(), "1 of the 2");
    table("ego_pose", pose_entry("e1", "1", "9, 0, 0, 0"));
    EXPECT_HAS(scene_error(), "length 9");
    table("ego_pose", entry("e1", R"("translation": "none")"));
    EXPECT_HAS(scene_error(), "no table");
    for (const char* file : {"../x/LIDAR_TOP/a.pcd.bin", "/x/LIDAR_TOP/a.pcd.bin"}) {
        table("sample_data", sweep(file, "1", "k1", "e1"));
        EXPECT_HAS(scene_error(), "elsewhere");
    }
    table("sample_data", sweep("sweeps/LIDAR_TOP/missing.pcd.bin", "1", "k1", "e1"));
    EXPECT_HAS(scene_error(), "no scan");
    table("sample_data", "");
    EXPECT_HAS(scene_error(), "no scan");
    data.put("v1.0-mini/sample.json", "{");
    EXPECT_HAS(scene_error(), "sample.json");
    data.put("v1.0-test/sample_data.json", "[]");
    EXPECT_HAS(scene_error(), "v1.0-test");
}

}  // namespace nuscenes_test
}  // namespace dynamic_filter::io
