// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace argoverse_test {

using Argoverse = RecordingFiles;

TEST_F(Argoverse, LogsAreRefusedWithWhatToDo) {
    data.put("sensors/lidar/315966265259836000.feather", "ARROW1");
    data.put("city_SE3_egovehicle.feather", "ARROW1");
    for (const char* given : {"", "sensors", "sensors/lidar"}) {
        const std::string error = error_of([&] { (void)open_recording(data / given); });
        EXPECT_HAS(error, "Argoverse 2");
        EXPECT_HAS(error, "docs/formats.md");
    }
    std::filesystem::create_directories(data / "av2/val/LOG");
    std::filesystem::rename(data / "sensors", data / "av2/val/LOG/sensors");
    std::filesystem::remove(data / "city_SE3_egovehicle.feather");
    for (const char* given : {"av2", "av2/val", "av2/val/LOG"}) {
        EXPECT_HAS(error_of([&] { (void)open_recording(data / given); }), "Argoverse 2");
    }
    const auto file = data / "av2/val/LOG/sensors/lidar/315966265259836000.feather";
    EXPECT_HAS(error_of([&] { (void)read_cloud(file); }), "Argoverse 2");
}

}  // namespace argoverse_test
}  // namespace dynamic_filter::io
