// SPDX-License-Identifier: MIT
// Drives are parts of simulated recordings, with poses that are off as those of users are.
#include "dynamic_filter/check.hpp"

#include <cmath>
#include <functional>
#include <map>

#include "commands/write_simulation.hpp"
#include "dynamic_filter/parallel.hpp"
#include "support/changed.hpp"
#include "support/random.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace compare_drives_test {

constexpr double kDegree = 3.14159265358979 / 180.0;

/// A simulated recording, made once for all tests.
const std::filesystem::path& recording(const char* scene_name, const char* sensor) {
    static const TemporaryFolder folder;
    const std::string scene = scene_name;
    static std::map<std::string, std::filesystem::path> made;
    const std::string name = scene + "_" + sensor;
    const auto [it, fresh] = made.try_emplace(name, folder / name);
    if (fresh) {
        sim::SimulationOptions options;
        options.scene = scene;
        options.sensor = sensor;
        options.rate_hz = scene == "crowd" ? 1.0 : 2.0;  // of two rounds, so that places come again
        if (scene == "crowd") options.pedestrians = 40;
        if (scene != "crowd") options.frames = 28;
        std::filesystem::create_directories(it->second);
        app::write_simulation(options, it->second, true);
    }
    return it->second;
}

Recording part(const std::filesystem::path& data, std::size_t first,
               std::optional<std::size_t> last, std::size_t stride = 1) {
    OpenOptions how;
    how.first = first;
    how.last = last;
    how.stride = stride;
    return open_recording(data, how);
}

struct TwoDrives {
    Recording a, b;

    [[nodiscard]] std::vector<const Recording*> all() const { return {&a, &b}; }
    [[nodiscard]] DriveOffset offset() const { return measure_drive_offsets(all()).at(0); }
    [[nodiscard]] std::vector<Finding> findings() const { return compare_drives(all()); }
};

/// The first and the second round in the crowd: other people, the same houses.
TwoDrives rounds() {
    const auto& data = recording("crowd", "vlp16");
    const std::size_t half = open_recording(data).size() / 2;
    return {part(data, 0, half - 5), part(data, half + 5, {})};
}

/// Every second scan for each drive.
TwoDrives alternate(const std::filesystem::path& data) {
    return {part(data, 0, {}, 2), part(data, 1, {}, 2)};
}

void change_poses(Recording& drive, const std::function<Pose(const Pose&)>& change) {
    drive = with_changed_poses(drive, change);
}

Pose displacement(double x, double y, double z, double yaw_deg) {
    return Eigen::Translation3d(x, y, z) *
           Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
}

void expect_found(TwoDrives drives, const Pose& error) {
    change_poses(drives.b, [&](const Pose& pose) { return error * pose; });
    const DriveOffset offset = drives.offset();
    EXPECT_EQ(offset.match, FrameMatch::shifted) << error.matrix();
    const double yaw = std::atan2(error(1, 0), error(0, 0)) / kDegree;
    EXPECT_NEAR(offset.yaw_deg, yaw, 0.2);
    // The error moves the pivot by this.
    const Eigen::Vector3d shift = error * offset.pivot - offset.pivot;
    EXPECT_LT((offset.shift - shift).cwiseAbs().maxCoeff(), 0.05)
        << offset.shift.transpose() << " instead of " << shift.transpose();
    const std::vector<Finding> findings = findings_of(drives.all(), std::vector{offset});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NE(findings[0].what.find("differ"), std::string::npos);
}

TEST(CompareDrives, ConstantOffsetsAreNamedWithTheirSize) {
    for (const Pose& error :
         {displacement(0.3, 0, 0, 0), displacement(1.5, -2, 0, 0), displacement(0, 0, 0.4, 0),
          displacement(0, 0, 0, 1.5), displacement(-4, 3, 1, -4), displacement(0, 0, 47, 0)}) {
        expect_found(rounds(), error);
    }
    for (const Pose& error : {displacement(0.3, 0, 0, 0), displacement(0, 0, 0, 1.5)}) {
        expect_found(alternate(recording("street", "vlp16")), error);
    }
}

TEST(CompareDrives, NothingIsFoundWithoutAnOffset) {
    EXPECT_TRUE(rounds().findings().empty());
    EXPECT_EQ(rounds().offset().match, FrameMatch::equal);
    for (const char* scene : {"street", "square", "hall", "platform"}) {
        const TwoDrives drives = alternate(recording(scene, "vlp16"));
        EXPECT_EQ(drives.offset().match, FrameMatch::equal) << scene;
        EXPECT_GT(drives.offset().fitting, 0U) << scene;
        EXPECT_TRUE(drives.findings().empty()) << scene;
    }
}

TEST(CompareDrives, DrivesMayHaveDifferentSensors) {
    const auto drives = [] {
        return TwoDrives{open_recording(recording("street", "vlp16")),
                         part(recording("street", "os64"), 0, 26)};
    };
    EXPECT_EQ(drives().offset().match, FrameMatch::equal);
    expect_found(drives(), displacement(1.5, -2, 0, 0));
    expect_found(drives(), displacement(0, 0, 0.4, 0));
}

TEST(CompareDrives, FramesFarFromTheOriginAreCompared) {
    TwoDrives drives = rounds();
    for (Recording* drive : {&drives.a, &drives.b}) {
        change_poses(*drive, [](const Pose& pose) {
            return Pose(Eigen::Translation3d(4.5e5, 5.4e6, 110.0) * pose);
        });
    }
    EXPECT_EQ(drives.offset().match, FrameMatch::equal);
    expect_found(drives, displacement(0, 0.3, 0, 0));
}

TEST(CompareDrives, DriftIsNoConstantOffset) {
    TwoDrives drives = rounds();
    const double count = static_cast<double>(drives.b.size());
    double i = 0.0;
    change_poses(drives.b, [&](Pose pose) {
        const double turn = 6.0 * i++ / count;
        pose.translation() += Eigen::Vector3d(std::sin(turn), std::cos(turn), 0.0);
        return pose;
    });
    EXPECT_EQ(drives.offset().match, FrameMatch::drifting);
    ASSERT_EQ(drives.findings().size(), 1U);
    EXPECT_NE(drives.findings()[0].what.find("no constant offset"), std::string::npos);
}

TEST(CompareDrives, FramesOfTheirOwnShowOtherSurroundings) {
    const TwoDrives drives{rounds().a, open_recording(recording("street", "vlp16"))};
    EXPECT_EQ(drives.offset().match, FrameMatch::unlike);
    ASSERT_EQ(drives.findings().size(), 1U);
    EXPECT_NE(drives.findings()[0].what.find("different surroundings"), std::string::npos);
}

TEST(CompareDrives, DistantFramesAndEqualPosesAreNamed) {
    TwoDrives drives = rounds();
    change_poses(drives.b,
                 [](const Pose& pose) { return Pose(Eigen::Translation3d(4e5, 0.0, 0.0) * pose); });
    EXPECT_EQ(drives.offset().match, FrameMatch::apart);
    ASSERT_EQ(drives.findings().size(), 1U);
    EXPECT_NE(drives.findings()[0].advice.find("UTM"), std::string::npos);
    drives.b = drives.a;
    EXPECT_EQ(drives.offset().match, FrameMatch::same_poses);
    drives.b = changed(drives.b, [](Info& info) { info.has_poses = false; });
    EXPECT_TRUE(measure_drive_offsets(drives.all()).empty());
    ASSERT_EQ(drives.findings().size(), 1U);
    EXPECT_NE(drives.findings()[0].what.find("has no poses"), std::string::npos);
}

TEST(CompareDrives, ADriveIsComparedWithThreeOthersAtMost) {
    const auto& data = recording("hall", "vlp16");
    std::vector<Recording> drives;
    for (std::size_t i = 0; i < 5; ++i) drives.push_back(part(data, i, {}, 5));
    std::vector<const Recording*> all;
    for (const Recording& drive : drives) all.push_back(&drive);
    std::size_t measured = 0;
    const auto offsets = measure_drive_offsets(all);
    for (const DriveOffset& offset : offsets) {
        measured += offset.match == FrameMatch::equal ? 1 : 0;
    }
    EXPECT_EQ(offsets.size(), 10U);
    EXPECT_EQ(measured, 1U + 2U + 3U + 3U);
}

TEST(CompareDrives, TheResultDoesNotDependOnTheNumberOfThreads) {
    TwoDrives drives = rounds();
    change_poses(drives.b, [](const Pose& pose) { return displacement(0.5, 0, 0, 0.7) * pose; });
    std::vector<DriveOffset> offsets(2);
    for (const int threads : {1, 3}) {
        with_threads(threads, [&] { offsets[threads == 1 ? 0 : 1] = drives.offset(); });
    }
    EXPECT_EQ(offsets[0].shift, offsets[1].shift);
    EXPECT_EQ(offsets[0].yaw_deg, offsets[1].yaw_deg);
}

// Of drives that are known to fit, the scans are not compared.
TEST(CompareDrives, ThoseThatAreKnownAreTakenToFit) {
    TwoDrives drives = rounds();
    change_poses(drives.b, [](const Pose& pose) { return displacement(1, 0, 0, 0) * pose; });
    const std::vector<const Recording*> all = drives.all();
    EXPECT_EQ(measure_drive_offsets(all).at(0).match, FrameMatch::shifted);
    EXPECT_EQ(measure_drive_offsets(all, 2).at(0).match, FrameMatch::equal);
    EXPECT_EQ(measure_drive_offsets(all, 2).at(0).places, 0U);
}

}  // namespace compare_drives_test
}  // namespace dynamic_filter::io
