// SPDX-License-Identifier: MIT
// Copies of a simulated recording, each with a mistake that users make.
#include "dynamic_filter/check.hpp"

#include <functional>

#include "commands/write_simulation.hpp"
#include "support/changed.hpp"
#include "support/random.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace preflight_test {

class Check : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        sim::SimulationOptions options;
        options.scene = "square";
        options.sensor = "vlp16";
        options.frames = 60;
        app::write_simulation(options, folder->path(), true);
    }
    static void TearDownTestSuite() { folder.reset(); }

    static Preflight after(const std::function<void(Info&)>& mistake,
                           Depth depth = Depth::thorough) {
        return check_recording(changed(open_recording(folder->path()), mistake), depth);
    }
    /// The recording with other points.
    static std::unique_ptr<TemporaryFolder> write_copy(
        const std::function<Points(const FullScan&)>& points_of) {
        auto copy = std::make_unique<TemporaryFolder>();
        const Recording recording = open_recording(folder->path());
        std::filesystem::create_directories(copy->path() / "velodyne");
        for (std::size_t i = 0; i < recording.size(); ++i) {
            const Points points = points_of(recording.read(i));
            write_bin(copy->path() / "velodyne" / (stem(recording, i) + ".bin"), points,
                      std::vector<float>(points.size()));
        }
        write_poses_kitti(copy->path() / "poses.txt", recording.info().T_world_sensor);
        return copy;
    }
    static void change_poses(Info& info, const std::function<Pose(const Pose&)>& change) {
        for (Pose& pose : info.T_world_sensor) pose = change(pose);
    }
    static std::unique_ptr<TemporaryFolder> folder;
};
std::unique_ptr<TemporaryFolder> Check::folder;

void expect_only(const Preflight& result, const std::string& what, const std::string& advice) {
    ASSERT_EQ(result.findings.size(), 1U) << what;
    EXPECT_NE(result.findings[0].what.find(what), std::string::npos) << result.findings[0].what;
    EXPECT_NE(result.findings[0].advice.find(advice), std::string::npos);
}

TEST_F(Check, FindsNothingInTheOriginal) {
    const Preflight result = after([](Info&) {});
    EXPECT_TRUE(result.findings.empty()) << result.findings[0].what;
    EXPECT_EQ(result.overlays.front().reading, "as given");
    EXPECT_GT(result.overlays.front().share, 0.4);
}

TEST_F(Check, ReadsScansAtSeveralPlaces) {
    EXPECT_EQ(after([](Info&) {}).scans, 36U);
    const Preflight quick = after([](Info&) {}, Depth::quick);
    EXPECT_EQ(quick.scans, 12U);
    EXPECT_TRUE(quick.findings.empty());
    EXPECT_GT(quick.overlays.front().share, 0.4);
    const Preflight without = after([](Info& info) {
        info.has_poses = false;
        info.T_world_sensor.clear();
    });
    EXPECT_TRUE(without.overlays.empty());
    EXPECT_TRUE(without.findings.empty());
    EXPECT_EQ(without.scans, 36U);
}

TEST_F(Check, NamesTheReadingOfThePosesThatFits) {
    const std::vector<std::pair<PoseFix, PoseFix>> undone_by = {
        {PoseFix::inverse, PoseFix::inverse},
        {PoseFix::camera, PoseFix::lidar},
        {PoseFix::lidar, PoseFix::camera},
        {PoseFix::wxyz, PoseFix::xyzw},
        {PoseFix::xyzw, PoseFix::wxyz}};
    for (const auto& [mistake, fix] : undone_by) {
        const Preflight result = after([&, m = mistake](Info& info) {
            change_poses(info, [m](const Pose& pose) { return fixed(m, pose); });
        });
        expect_only(result, "overlay", "--pose-fix " + to_string(fix));
    }
    const auto thousandfold = [](Info& info) {
        change_poses(info, [](Pose pose) {
            pose.translation() *= 1000.0;
            return pose;
        });
    };
    expect_only(after(thousandfold), "millimetres", "--pose-fix mm");
}

TEST_F(Check, NamesPosesThatDoNotMoveAndThoseOfAnotherWay) {
    expect_only(after([](Info& info) {
                    change_poses(info,
                                 [first = info.T_world_sensor[0]](const Pose&) { return first; });
                }),
                "all poses are equal", "--poses");
    expect_only(after([](Info& info) {
                    for (std::size_t i = 0; i < info.scan_files.size(); ++i) {
                        const double angle = 0.3 * static_cast<double>(i);
                        info.T_world_sensor[i] =
                            Eigen::Translation3d(30.0 * std::cos(angle), 30.0 * std::sin(angle), 0);
                    }
                }),
                "do not fit", "--poses");
}

TEST_F(Check, EqualPosesOfASensorThatStandsStillAreRight) {
    const auto still = write_copy(
        [first = open_recording(folder->path()).read(0)](const FullScan&) { return first.points; });
    const Recording recording = with_changed_poses(
        open_recording(still->path()), [](const Pose&) { return Pose(Pose::Identity()); });
    const Preflight result = check_recording(recording, Depth::thorough);
    EXPECT_TRUE(result.findings.empty()) << result.findings[0].what;
    EXPECT_EQ(result.overlays.front().share, 1.0);
}

TEST_F(Check, QuicklyFindsWhatIsWrongAsAWholeOnly) {
    const auto jitter = [](Info& info) {
        test::Random random(1);
        change_poses(info, [&](const Pose& pose) { return pose * random.pose(0.1, 0.01); });
    };
    expect_only(after(jitter), "jitter", "`run` refines such poses of a single recording");
    EXPECT_TRUE(after(jitter, Depth::quick).findings.empty());
    const auto inverse = [](Info& info) {
        change_poses(info, [](const Pose& pose) { return pose.inverse(); });
    };
    expect_only(after(inverse, Depth::quick), "inverse (T_sensor_world)", "--pose-fix inverse");
}

TEST_F(Check, NamesMotionThatIsStillInTheScans) {
    const TemporaryFolder swept;
    sim::SimulationOptions options;
    options.scene = "street";
    options.sensor = "vlp16";
    options.rate_hz = 5.0;
    options.frames = 45;
    options.sweep = true;
    app::write_simulation(options, swept.path(), true);
    const Recording recording = open_recording(swept.path());
    const Preflight swept_scans = check_recording(recording, Depth::thorough);
    EXPECT_TRUE(swept_scans.findings.empty()) << swept_scans.findings[0].what;
    ASSERT_EQ(swept_scans.notes.size(), 1U);
    EXPECT_HAS(swept_scans.notes[0], "motion during each scan");
    const Preflight undone = check_recording(deskewed(recording), Depth::thorough);
    EXPECT_TRUE(undone.findings.empty()) << undone.findings[0].what;
    EXPECT_TRUE(undone.notes.empty());
}

TEST_F(Check, NamesPointsInTheWorldAndMergedSensors) {
    const auto in_world = write_copy([](const FullScan& full) {
        Points points = full.points;
        for (Point& p : points) p = (full.T_world_sensor * p.cast<double>()).cast<float>();
        return points;
    });
    const Recording world = open_recording(in_world->path());
    expect_only(check_recording(world, Depth::thorough), "world's frame", "--points-in-world");
    OpenOptions as_they_are;
    as_they_are.points_in_world = true;
    EXPECT_TRUE(check_recording(open_recording(in_world->path(), as_they_are), Depth::thorough)
                    .findings.empty());
    for (const Depth depth : {Depth::quick, Depth::thorough}) {  // and where they are not
        expect_only(check_recording(open_recording(folder->path(), as_they_are), depth),
                    "in the sensor's frame", "leave out --points-in-world");
    }

    const TemporaryFolder benchmark;  // whose files have points in the world's frame
    const Recording original = open_recording(folder->path());
    std::filesystem::create_directories(benchmark / "pcd");
    for (std::size_t i = 0; i < original.size(); ++i) {
        Cloud cloud = original.read(i).cloud;
        cloud.viewpoint = original.info().T_world_sensor[i];
        write_pcd(benchmark / ("pcd/" + stem(original, i) + ".pcd"), cloud);
    }
    expect_only(check_recording(open_recording(benchmark.path()), Depth::quick),
                "but this format has them in the world's", "--format folder");

    const auto merged = write_copy([](const FullScan& full) {
        Points points = full.points;
        const Eigen::Isometry3f other =
            Eigen::Translation3f(1.2F, 0.5F, -0.3F) * Eigen::AngleAxisf(0.02F, Point::UnitZ());
        for (const Point& p : full.points) points.push_back(other * p);
        return points;
    });
    expect_only(check_recording(open_recording(merged->path()), Depth::thorough), "merged", "one");
}

TEST_F(Check, NamesTheUnitOfPoints) {
    for (const auto& [scale, name, advice] :
         {std::tuple{1000.0F, "are in millimetres", "--point-unit mm"},
          {100.0F, "are in centimetres", "--point-unit cm"},
          {3.28084F, "the points are in feet", "--point-unit feet"}}) {
        const auto copy = write_copy([scale = scale](const FullScan& full) {
            Points points = full.points;
            for (Point& p : points) p *= scale;
            return points;
        });
        expect_only(check_recording(open_recording(copy->path()), Depth::quick), name, advice);
    }
}

TEST_F(Check, NamesCoordinatesTooFarFromTheirOriginForFloat32) {
    // As sums of the place in the world and of the poses.
    for (const double far : {1e4, 5e6}) {
        const auto copy = write_copy([far](const FullScan& full) {
            Points points = full.points;
            const Eigen::Vector3d origin(far, far, 0.0);
            for (Point& p : points) {
                p = (full.T_world_sensor * p.cast<double>() + origin).cast<float>();
            }
            return points;
        });
        OpenOptions how;
        how.points_in_world = true;
        std::vector<Pose> poses = open_recording(copy->path(), how).info().T_world_sensor;
        for (Pose& pose : poses) pose.translation() += Eigen::Vector3d(far, far, 0.0);
        write_poses_kitti(copy->path() / "poses.txt", poses);
        const Preflight found = check_recording(open_recording(copy->path(), how), Depth::quick);
        if (far < 1e5) {
            EXPECT_TRUE(found.findings.empty()) << found.findings.front().what;
        } else {
            expect_only(found, "coordinates of type float32 are 0.5 m apart", "float64");
        }
    }
}

TEST_F(Check, PointsFarFromTheOriginInOneDirectionAreInTheWorld) {
    const auto copy = write_copy([](const FullScan& full) {
        Points points = full.points;
        for (Point& p : points) p = (full.T_world_sensor * p.cast<double>()).cast<float>();
        for (Point& p : points) p += Point(4e5F, 5e6F, 100.0F);
        return points;
    });
    std::filesystem::remove(copy->path() / "poses.txt");
    expect_only(check_recording(open_recording(copy->path()), Depth::quick),
                "all in one direction: they are in the world's frame", "--points-in-world");
}

TEST_F(Check, NamesPosesOfAnotherRecordingWhateverTheirReading) {
    expect_only(after([](Info& info) {
                    double far = 0.0;
                    change_poses(info, [&](const Pose& pose) {
                        far += 200.0;
                        Pose apart = pose;
                        apart.translation() += Eigen::Vector3d(far, -2.0 * far, 3e3);
                        return apart;
                    });
                }),
                "do not", "--poses none");
}

TEST_F(Check, FindsNothingWhereScansOfAStreetAreFarApart) {
    const TemporaryFolder street;
    sim::SimulationOptions options;
    options.scene = "city";
    options.km = 0.4;
    options.frames = 160;
    app::write_simulation(options, street.path(), true);
    OpenOptions sparse;
    sparse.stride = 16;
    const Recording recording = open_recording(street.path(), sparse);
    const Preflight result = check_recording(recording, Depth::quick);
    EXPECT_TRUE(result.findings.empty()) << result.findings[0].what;
}

TEST_F(Check, ASensorThatHangsUpsideDownOnAStraightPathIsNoticed) {
    // The readings of the quaternion overlay alike there.
    const TemporaryFolder straight;
    sim::SimulationOptions options;
    options.scene = "crowd";
    options.sensor = "vlp16";
    options.frames = 30;
    app::write_simulation(options, straight.path(), true);
    const Recording recording = open_recording(straight.path());
    EXPECT_TRUE(check_recording(recording, Depth::thorough).findings.empty());
    const Recording hanging =
        with_changed_poses(recording, [](const Pose& pose) { return fixed(PoseFix::xyzw, pose); });
    const Preflight result = check_recording(hanging, Depth::thorough);
    ASSERT_FALSE(result.findings.empty());
    EXPECT_NE(result.findings[0].advice.find("--pose-fix wxyz"), std::string::npos);
}

TEST_F(Check, NamesTheUnitOfTime) {
    for (const auto& [unit, factor] : {std::pair{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}}) {
        const Preflight result = after([&, f = factor](Info& info) {
            for (double& stamp : info.stamps) stamp *= f;
        });
        expect_only(result, "not in seconds", std::string("--time-unit ") + unit);
    }
}

TEST_F(Check, NamesStampsOfPosesThatAreNotThoseOfTheScans) {
    const auto with = [](double from, double factor, double shift) {
        return after([=](Info& info) {
            for (double& stamp : info.stamps) stamp += from;
            for (const double stamp : info.stamps)
                info.pose_stamps.push_back(factor * (stamp + shift));
        });
    };
    EXPECT_TRUE(with(1e9, 1.0, 0.05).findings.empty());
    EXPECT_TRUE(with(0.0, 1.0, 1e9).findings.empty()) << "a clock that begins at 0";
    expect_only(with(1e9, 1.0, -3.0), "3 s before those of the scans", "--poses");
    expect_only(with(1e9, 1e9, 0.0), "the poses' stamps are in ns", "in seconds");
    expect_only(with(1e9, 1e3, 0.0), "the poses' stamps are in ms", "in seconds");
    expect_only(with(1e9, 1e-3, 0.0), "the scans' stamps are in ms", "--time-unit ms");
}

/// A recording of five scans without structures, of which only the stamps matter.
class Stamps : public RecordingFiles {
protected:
    void SetUp() override {
        put_bins("velodyne", 5);
        data.put("poses.txt", kitti_rows(5));
    }
    [[nodiscard]] Preflight with(double step, double first = 1e9, double pose_shift = 0.0,
                                 bool measured = true) const {
        const Recording recording = changed(open(), [&](Info& info) {
            info.measured_stamps = measured;
            for (std::size_t i = 0; i < 5; ++i) {
                info.stamps[i] = first + step * static_cast<double>(i);
                if (pose_shift == 0.0) continue;
                info.pose_stamps.push_back(info.stamps[i] + pose_shift);
            }
        });
        return check_recording(recording, Depth::quick);
    }
};

TEST_F(Stamps, OfUsualScansAreFine) {
    for (const double step : {0.002, 0.1, 1.0, 19.9}) {
        EXPECT_TRUE(with(step, 0.0).findings.empty()) << step;
    }
    EXPECT_TRUE(with(1e6, 0.0, 0.0, false).findings.empty()) << "assumed stamps";
    EXPECT_TRUE(with(0.125, 1e9, 0.09).findings.empty()) << "within three quarters of a scan";
    EXPECT_TRUE(with(0.125, 1e9, -0.09).findings.empty());
}

TEST_F(Stamps, InOtherUnitsAreNamedWithTheUnit) {
    for (const auto& [step, unit] :
         {std::pair{20.0, "ms"}, {9900.0, "ms"}, {15000.0, "us"}, {9.9e6, "us"}, {1e8, "ns"}}) {
        expect_only(with(step, 0.0), "not in seconds", "--time-unit " + std::string(unit));
    }
    expect_only(with(100.0, 0.0), "scans are 100 apart, which is 0.1 s if the unit is ms", "ms");
}

TEST_F(Stamps, OfNoUnitAreNamed) {
    expect_only(with(0.0, 0.0), "scans are 0 s apart", "should be in seconds");
    expect_only(with(-0.5, 10.0), "scans are -0.5 s apart", "should be in seconds");
    expect_only(with(0.0009765625, 0.0), "scans are 0.000977 s apart", "should be in seconds");
    expect_only(with(1e12, 0.0), "scans are 1e+12 s apart", "should be in seconds");
}

TEST_F(Stamps, InWholeSecondsOfFasterScansAreNamed) {
    const Recording rounded = changed(open(), [](Info& info) {
        info.measured_stamps = true;
        info.stamps = {7, 7, 7, 8, 8};
    });
    expect_only(check_recording(rounded, Depth::quick), "rounded to whole seconds", "fractions");
}

TEST_F(Stamps, OfPosesThatAreNotThoseOfTheScansAreNamed) {
    expect_only(with(0.125, 1e9, 0.25), "0.25 s after those of the scans, which are 0.125 s apart",
                "--poses");
    expect_only(with(0.125, 1e9, -0.125), "0.125 s before those of the scans", "--poses");
}

TEST_F(Stamps, OfTwoScansSayNothing) {
    const Recording two = changed(slice(open(), 0, 1), [](Info& info) {
        info.stamps = {0.0, 1e6};
        info.measured_stamps = true;
    });
    EXPECT_TRUE(check_recording(two, Depth::quick).findings.empty());
}

/// Scans with absolute times, one every 0.1 s, under the names that `name_of` gives them.
std::unique_ptr<TemporaryFolder> write_timed(const std::function<std::string(std::size_t)>& name_of,
                                             double beginning) {
    auto folder = std::make_unique<TemporaryFolder>();
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
    const auto findings = [](const TemporaryFolder& recording) {
        return check_recording(open_recording(recording.path()), Depth::quick);
    };
    EXPECT_TRUE(findings(*write_timed(in_order, 1.5e9)).findings.empty());
    EXPECT_TRUE(findings(*write_timed(turned_round, 0.0)).findings.empty())
        << "no clock of the world";
    const Preflight result = findings(*write_timed(turned_round, 1.5e9));
    expect_only(result, "was taken", "rename");
    expect_only(result, "whose name comes first", "rename");
}

TEST_F(Check, ListsTheScansThatARunRejects) {
    const auto copy = write_copy([](const FullScan& full) { return full.points; });
    const auto scan = [&](const char* name) { return copy->path() / "velodyne" / name; };
    std::filesystem::resize_file(scan("000007.bin"), 1001);
    std::filesystem::resize_file(scan("000058.bin"), 0);
    test::spill(scan("000000.bin"), std::string(160, '\0'));  // at the sensor, all of them
    const Preflight result = check_recording(open_recording(copy->path()), Depth::thorough);
    ASSERT_EQ(result.unusable.size(), 3U);
    EXPECT_NE(result.unusable[0].find("000000: "), std::string::npos);
    EXPECT_NE(result.unusable[1].find("000007: "), std::string::npos);
    EXPECT_NE(result.unusable[2].find("is empty"), std::string::npos);
    EXPECT_TRUE(result.findings.empty());
}

}  // namespace preflight_test
}  // namespace dynamic_filter::io
