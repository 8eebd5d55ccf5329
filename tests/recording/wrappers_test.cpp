// SPDX-License-Identifier: MIT
// Recordings that are made of others.
#include "support/changed.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace wrappers_test {

class Wrappers : public RecordingFiles {
protected:
    void SetUp() override {
        for (std::size_t i = 0; i < 10; ++i) put_timed(i);
        put_labels(10);
        data.put("track.tum", tum_rows(10, 100.0));
    }
    [[nodiscard]] Recording of_layout(const char* name) const {
        OpenOptions options;
        options.layout = name;
        return open(options);
    }
    /// Two points, the second 50 ms after the first.
    void put_timed(std::size_t i) const {
        Cloud cloud;
        for (const char* name : {"x", "y", "z", "t"}) add_field(cloud, name, FieldType::f32);
        const auto x = static_cast<float>(i + 1);
        const std::string bytes = floats({x, 2, 3, 0, 4, 5, 6, 0.05F});
        const auto raw = std::as_bytes(std::span(bytes));
        cloud.data.assign(raw.begin(), raw.end());
        std::filesystem::create_directories(data / "scans");
        write_pcd(data / "scans" / (number(i) + ".pcd"), cloud);
    }
};

void expect_same(const Recording& a, const Recording& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(a.info().scan_files, b.info().scan_files);
    EXPECT_EQ(a.info().stamps, b.info().stamps);
    EXPECT_EQ(a.info().notes, b.info().notes);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const FullScan one = a.read(i), other = b.read(i);
        EXPECT_EQ(one.points, other.points) << i;
        EXPECT_EQ(one.times, other.times) << i;
        EXPECT_EQ(one.stamp, other.stamp) << i;
        EXPECT_EQ(one.has_pose, other.has_pose) << i;
        EXPECT_EQ(one.T_world_sensor.matrix(), other.T_world_sensor.matrix()) << i;
        EXPECT_EQ(one.truth, other.truth) << i;
    }
}

std::vector<std::optional<Tracked>> tracked(std::size_t count) {
    std::vector<std::optional<Tracked>> all(count, Tracked{});
    for (std::size_t i = 0; i < count; ++i) {
        all[i]->T_world_sensor = Pose(Eigen::Translation3d(0, static_cast<double>(i), 0));
        all[i]->velocity = Twist::Constant(0.5);
    }
    return all;
}

// The first scan may be damaged: a known sweep tells the times without it.
TEST_F(Wrappers, AKnownSweepNeedsNoLookAtTheScans) {
    data.put("scans/000000.pcd", "damaged");
    EXPECT_TRUE(deskewed(open(), Sweep{}).info().deskewed);
}

TEST_F(Wrappers, ARecordingIsAValue) {
    const Recording recording = open(), copy = recording;
    EXPECT_EQ(&copy.info(), &recording.info());  // shared
    EXPECT_EQ(with_notes(recording, {"more"}).info().notes.back(), "more");
    EXPECT_NE(recording.info().notes.back(), "more");
    EXPECT_EQ(with_losses(recording, {"worse"}).info().losses, std::vector<std::string>{"worse"});
    EXPECT_TRUE(recording.info().losses.empty());
    EXPECT_EQ(Recording().size(), 0U);
}

TEST_F(Wrappers, ASliceIsWhatTheOptionsSelect) {
    OpenOptions options;
    options.first = 2;
    options.last = 8;
    options.stride = 3;
    expect_same(slice(open(), 2, 8, 3), open(options));
    EXPECT_EQ(stem(slice(open(), 2, 8, 3), 1), "000005");
    EXPECT_EQ(slice(open(), 2, 8, 3).read(1).points[0].x(), 6.0F);
    EXPECT_EQ(slice(open(), 9).size(), 1U);
    EXPECT_EQ(slice(open(), 0, {}, 100).size(), 1U);
    EXPECT_HAS(error_of<ConfigError>([&] { (void)slice(open(), 10); }), "--first 10");
    EXPECT_HAS(error_of<ConfigError>([&] { (void)slice(open(), 3, 2); }), "--last 2");
    EXPECT_HAS(error_of<ConfigError>([&] { (void)slice(open(), 0, {}, 0); }), "--stride");
}

TEST_F(Wrappers, SlicesOfSlicesAreSlices) {
    for (std::size_t first = 0; first < 4; ++first) {
        for (std::size_t stride = 1; stride < 4; ++stride) {
            const Recording once = slice(open(), 1 + 2 * first, {}, 2 * stride);
            expect_same(slice(slice(open(), 1, {}, 2), first, {}, stride), once);
        }
    }
}

TEST_F(Wrappers, SlicesCommuteWithTheOthers) {
    const auto slice_of = [](const Recording& recording) { return slice(recording, 1, 7, 2); };
    const Recording all = open();
    expect_same(slice_of(with_times(all)), with_times(slice_of(all)));
    expect_same(slice_of(without_poses(all)), without_poses(slice_of(all)));
    expect_same(slice_of(with_notes(all, {"a"})), with_notes(slice_of(all), {"a"}));
    const auto given = tracked(10);
    const std::vector chosen{given[1], given[3], given[5], given[7]};
    expect_same(slice_of(with_poses(all, given)), with_poses(slice_of(all), chosen));
    expect_same(slice_of(with_poses(with_times(all), given)),
                with_poses(with_times(slice_of(all)), chosen));
    // Motion is undone with all poses if it is undone first. Here the sensor moves steadily.
    const Recording before = deskewed(slice_of(all)), after = slice_of(deskewed(all));
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_TRUE(before.read(i).points[1].isApprox(after.read(i).points[1], 1e-5F)) << i;
    }
}

TEST_F(Wrappers, TimesAreThoseOfThePointsOrOfTheSweep) {
    EXPECT_TRUE(open().read(0).times.empty());
    EXPECT_EQ(with_times(open()).read(0).times, (std::vector<float>{0.0F, 0.05F}));
    put_bins("velodyne", 2);
    const Recording untimed = of_layout("kitti");
    EXPECT_TRUE(with_times(untimed).read(0).times.empty());
    const Sweep sweep{false, 0.0, 0.1};
    EXPECT_EQ(with_times(untimed, sweep).read(0).times.size(), 2U);
}

TEST_F(Wrappers, MotionIsUndoneWithThePosesOfTheRecording) {
    const Recording still = deskewed(open());
    EXPECT_TRUE(still.info().deskewed);
    // 1 m in 0.2 s, so the second point is 0.25 m further.
    EXPECT_NEAR(still.read(3).points[1].x(), 4.25F, 1e-4F);
    EXPECT_TRUE(deskewed(with_times(open())).read(3).times.empty());
}

TEST_F(Wrappers, ASensorElsewhereSeesTheSamePlacesInTheWorld) {
    const Eigen::Vector3d at(0.5, -1.0, 2.0);
    const auto world = [](const FullScan& scan, std::size_t i) -> Eigen::Vector3d {
        return scan.T_world_sensor * scan.points[i].cast<double>();
    };
    const Recording given = with_poses(with_times(open()), tracked(10));
    for (const Recording& recording : {open(), deskewed(open()), given}) {
        const Recording elsewhere = with_sensor_at(recording, at);
        EXPECT_EQ(elsewhere.info().sensor_at, at);
        for (std::size_t i = 0; i < recording.size(); ++i) {
            const FullScan scan = recording.read(i), other = elsewhere.read(i);
            for (std::size_t p = 0; p < 2; ++p) {
                EXPECT_LT((world(scan, p) - world(other, p)).norm(), 1e-4) << i;
            }
            EXPECT_TRUE(other.T_world_sensor.translation().isApprox(scan.T_world_sensor * at));
        }
        const Recording back = with_sensor_at(elsewhere, Eigen::Vector3d::Zero());
        EXPECT_TRUE(back.info().T_world_sensor[3].isApprox(recording.info().T_world_sensor[3]));
    }
}

TEST_F(Wrappers, PointsAtTheSensorAreNoReturns) {
    const FullScan scan = with_sensor_at(open(), {4, 5, 6.001}).read(0);
    EXPECT_TRUE(is_measured(scan.points[0]));
    EXPECT_FALSE(is_measured(scan.points[1]));
}

TEST_F(Wrappers, FoundPosesReplaceThoseThatThereAre) {
    auto found = tracked(10);
    found[4].reset();
    const Recording placed = with_poses(with_times(without_poses(open())), found);
    EXPECT_TRUE(placed.info().tracked);
    const FullScan scan = placed.read(3);
    EXPECT_EQ(scan.T_world_sensor.translation().y(), 3.0);
    EXPECT_TRUE(scan.has_pose);
    EXPECT_TRUE(scan.times.empty());  // used
    EXPECT_NE(scan.points[1], open().read(3).points[1]);
    EXPECT_HAS(error_of([&] { placed.check(4); }), "no pose");
    EXPECT_EQ(with_poses(open(), found).read(3).points, open().read(3).points);  // no times
}

TEST_F(Wrappers, WithoutPosesPointsAreAsInTheFiles) {
    put_pcd("pcd/0.pcd", 2.0, 0);
    const Recording in_world = of_layout("benchmark");
    EXPECT_EQ(in_world.read(0).points[0].x(), 8.0F);
    EXPECT_EQ(without_poses(in_world).read(0).points[0].x(), 10.0F);
    EXPECT_FALSE(without_poses(in_world).read(0).has_pose);
}

}  // namespace wrappers_test
}  // namespace dynamic_filter::io
