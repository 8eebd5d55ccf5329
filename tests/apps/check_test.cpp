// SPDX-License-Identifier: MIT
// check on copies of a simulated recording, each with a mistake that users make.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "dynamic_filter/io/preflight.hpp"
#include "dynamic_filter/io/writers.hpp"
#include "support/temporary_folder.hpp"
#include "write_simulation.hpp"

namespace dynamic_filter::io {
namespace {

class Check : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<test::TemporaryFolder>();
        sim::SimulationOptions options;
        options.scene = "square";
        options.sensor = "vlp16";
        options.frames = 60;
        app::write_simulation(options, folder->path());
    }
    static void TearDownTestSuite() { folder.reset(); }

    static Preflight after(const std::function<void(Sequence&)>& mistake,
                           const OpenOptions& options = {}) {
        Sequence sequence = open_sequence(folder->path(), options);
        mistake(sequence);
        return check_recording(sequence, Depth::thorough);
    }
    /// The recording with other points.
    static std::unique_ptr<test::TemporaryFolder> write_copy(
        const std::function<Points(const Frame&)>& points_of) {
        auto copy = std::make_unique<test::TemporaryFolder>();
        const Sequence sequence = open_sequence(folder->path());
        std::filesystem::create_directories(copy->path() / "velodyne");
        for (std::size_t i = 0; i < sequence.size(); ++i) {
            const Points points = points_of(read_frame(sequence, i));
            write_bin(copy->path() / "velodyne" / (stem(sequence, i) + ".bin"), points,
                      std::vector<float>(points.size()));
        }
        write_poses_kitti(copy->path() / "poses.txt", sequence.T_world_sensor);
        return copy;
    }
    static void change_poses(Sequence& sequence, const std::function<Pose(const Pose&)>& change) {
        for (Pose& pose : sequence.T_world_sensor) pose = change(pose);
    }
    static std::unique_ptr<test::TemporaryFolder> folder;
};
std::unique_ptr<test::TemporaryFolder> Check::folder;

void expect_only(const Preflight& result, const std::string& what, const std::string& advice) {
    ASSERT_EQ(result.findings.size(), 1U) << what;
    EXPECT_NE(result.findings[0].what.find(what), std::string::npos) << result.findings[0].what;
    EXPECT_NE(result.findings[0].advice.find(advice), std::string::npos);
}

TEST_F(Check, FindsNothingInTheOriginal) {
    const Preflight result = after([](Sequence&) {});
    EXPECT_TRUE(result.findings.empty()) << result.findings[0].what;
    EXPECT_EQ(result.overlays.front().reading, "as given");
    EXPECT_GT(result.overlays.front().share, 0.4);
}

TEST_F(Check, NamesTheReadingOfThePosesThatFits) {
    const std::vector<std::pair<PoseFix, PoseFix>> undone_by = {
        {PoseFix::inverse, PoseFix::inverse},
        {PoseFix::camera, PoseFix::lidar},
        {PoseFix::lidar, PoseFix::camera},
        {PoseFix::wxyz, PoseFix::xyzw},
        {PoseFix::xyzw, PoseFix::wxyz}};
    for (const auto& [mistake, fix] : undone_by) {
        const Preflight result = after([&, m = mistake](Sequence& sequence) {
            change_poses(sequence, [m](const Pose& pose) { return fixed(m, pose); });
        });
        expect_only(result, "overlay", "--pose-fix " + to_string(fix));
    }
    const auto thousandfold = [](Sequence& sequence) {
        change_poses(sequence, [](Pose pose) {
            pose.translation() *= 1000.0;
            return pose;
        });
    };
    expect_only(after(thousandfold), "millimetres", "--pose-fix mm");
}

TEST_F(Check, NamesPosesThatDoNotMoveAndThoseOfAnotherWay) {
    expect_only(after([](Sequence& sequence) {
                    change_poses(sequence, [first = sequence.T_world_sensor[0]](const Pose&) {
                        return first;
                    });
                }),
                "all poses are equal", "--poses");
    expect_only(after([](Sequence& sequence) {
                    for (std::size_t i = 0; i < sequence.size(); ++i) {
                        const double angle = 0.3 * static_cast<double>(i);
                        sequence.T_world_sensor[i] =
                            Eigen::Translation3d(30.0 * std::cos(angle), 30.0 * std::sin(angle), 0);
                    }
                }),
                "do not fit", "--poses");
}

TEST_F(Check, NamesPointsInTheWorldAndMergedSensors) {
    const auto in_world = write_copy([](const Frame& frame) {
        Points points = frame.points;
        for (Point& p : points) p = (frame.T_world_sensor * p.cast<double>()).cast<float>();
        return points;
    });
    const Sequence world = open_sequence(in_world->path());
    expect_only(check_recording(world, Depth::thorough), "world's frame", "--points-in-world");
    OpenOptions as_they_are;
    as_they_are.points_in_world = true;
    EXPECT_TRUE(check_recording(open_sequence(in_world->path(), as_they_are), Depth::thorough)
                    .findings.empty());
    for (const Depth depth : {Depth::quick, Depth::thorough}) {  // and where they are not
        expect_only(check_recording(open_sequence(folder->path(), as_they_are), depth),
                    "in the sensor's frame", "leave out --points-in-world");
    }

    const auto merged = write_copy([](const Frame& frame) {
        Points points = frame.points;
        const Eigen::Isometry3f other =
            Eigen::Translation3f(1.2F, 0.5F, -0.3F) * Eigen::AngleAxisf(0.02F, Point::UnitZ());
        for (const Point& p : frame.points) points.push_back(other * p);
        return points;
    });
    expect_only(check_recording(open_sequence(merged->path()), Depth::thorough), "merged", "one");
}

TEST_F(Check, NamesPointsInMillimetres) {
    const auto copy = write_copy([](const Frame& frame) {
        Points points = frame.points;
        for (Point& p : points) p *= 1000.0F;
        return points;
    });
    for (const Depth depth : {Depth::quick, Depth::thorough}) {
        expect_only(check_recording(open_sequence(copy->path()), depth), "in millimetres",
                    "in metres");
    }
}

TEST_F(Check, NamesPosesOfAnotherRecordingWhateverTheirReading) {
    expect_only(after([](Sequence& sequence) {
                    double far = 0.0;
                    change_poses(sequence, [&](const Pose& pose) {
                        far += 200.0;
                        Pose apart = pose;
                        apart.translation() += Eigen::Vector3d(far, -2.0 * far, 3e3);
                        return apart;
                    });
                }),
                "do not", "--poses none");
}

TEST_F(Check, ASensorThatHangsUpsideDownOnAStraightPathIsNoticed) {
    // The readings of the quaternion overlay alike there.
    const test::TemporaryFolder straight;
    sim::SimulationOptions options;
    options.scene = "crowd";
    options.sensor = "vlp16";
    options.frames = 30;
    app::write_simulation(options, straight.path());
    Sequence sequence = open_sequence(straight.path());
    EXPECT_TRUE(check_recording(sequence, Depth::thorough).findings.empty());
    change_poses(sequence, [](const Pose& pose) { return fixed(PoseFix::xyzw, pose); });
    const Preflight result = check_recording(sequence, Depth::thorough);
    ASSERT_FALSE(result.findings.empty());
    EXPECT_NE(result.findings[0].advice.find("--pose-fix wxyz"), std::string::npos);
}

TEST_F(Check, NamesTheUnitOfTime) {
    for (const auto& [unit, factor] : {std::pair{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}}) {
        const Preflight result = after([&, f = factor](Sequence& sequence) {
            for (double& stamp : sequence.stamps) stamp *= f;
        });
        expect_only(result, "not in seconds", std::string("--time-unit ") + unit);
    }
}

TEST_F(Check, NamesStampsOfPosesThatAreNotThoseOfTheScans) {
    const auto with = [](double from, double factor, double shift) {
        return after([=](Sequence& sequence) {
            for (double& stamp : sequence.stamps) stamp += from;
            for (const double stamp : sequence.stamps)
                sequence.pose_stamps.push_back(factor * (stamp + shift));
        });
    };
    EXPECT_TRUE(with(1e9, 1.0, 0.05).findings.empty());
    EXPECT_TRUE(with(0.0, 1.0, 1e9).findings.empty()) << "a clock that begins at 0";
    expect_only(with(1e9, 1.0, -3.0), "3 s before those of the scans", "--poses");
    expect_only(with(1e9, 1e9, 0.0), "the poses' stamps are in ns", "in seconds");
    expect_only(with(1e9, 1e3, 0.0), "the poses' stamps are in ms", "in seconds");
    expect_only(with(1e9, 1e-3, 0.0), "the scans' stamps are in ms", "--time-unit ms");
}

/// Scans with absolute times, one every 0.1 s, under the names that `name_of` gives them.
std::unique_ptr<test::TemporaryFolder> write_timed(
    const std::function<std::string(std::size_t)>& name_of, double beginning) {
    auto folder = std::make_unique<test::TemporaryFolder>();
    std::filesystem::create_directories(folder->path() / "scans");
    for (std::size_t i = 0; i < 12; ++i) {
        Cloud cloud;
        for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
        add_field(cloud, "timestamp", FieldType::f64);
        for (std::size_t p = 0; p < 5; ++p) {
            const float place[3] = {3.0F + static_cast<float>(p), 1.0F, 0.5F};
            const double time =
                beginning + 0.1 * static_cast<double>(i) + 0.01 * static_cast<double>(p);
            cloud.data.resize(cloud.data.size() + sizeof place + sizeof time);
            std::byte* end = cloud.data.data() + cloud.data.size();
            std::memcpy(end - sizeof time - sizeof place, place, sizeof place);
            std::memcpy(end - sizeof time, &time, sizeof time);
        }
        write_pcd(folder->path() / "scans" / (name_of(i) + ".pcd"), cloud);
    }
    return folder;
}

TEST_F(Check, NamesScansWhoseNamesAreInNoOrderOfTime) {
    const auto in_order = [](std::size_t i) { return "scan" + std::to_string(i); };
    const auto turned_round = [](std::size_t i) {
        return "scan" + std::to_string(i < 6 ? i + 6 : i - 6);
    };
    const auto findings = [](const test::TemporaryFolder& recording) {
        return check_recording(open_sequence(recording.path()), Depth::quick);
    };
    EXPECT_TRUE(findings(*write_timed(in_order, 1.5e9)).findings.empty());
    EXPECT_TRUE(findings(*write_timed(turned_round, 0.0)).findings.empty())
        << "no clock of the world";
    const Preflight result = findings(*write_timed(turned_round, 1.5e9));
    expect_only(result, "was taken", "rename");
    expect_only(result, "whose name comes first", "rename");
}

TEST_F(Check, ListsTheScansThatARunRejects) {
    const auto copy = write_copy([](const Frame& frame) { return frame.points; });
    const auto scan = [&](const char* name) { return copy->path() / "velodyne" / name; };
    std::filesystem::resize_file(scan("000007.bin"), 1001);
    std::filesystem::resize_file(scan("000058.bin"), 0);
    test::spill(scan("000000.bin"), std::string(160, '\0'));  // at the sensor, all of them
    const Preflight result = check_recording(open_sequence(copy->path()), Depth::thorough);
    ASSERT_EQ(result.unusable.size(), 3U);
    EXPECT_NE(result.unusable[0].find("000000: "), std::string::npos);
    EXPECT_NE(result.unusable[1].find("000007: "), std::string::npos);
    EXPECT_NE(result.unusable[2].find("is empty"), std::string::npos);
    EXPECT_TRUE(result.findings.empty());
}

}  // namespace
}  // namespace dynamic_filter::io
