// SPDX-License-Identifier: MIT
#include "page/run_view.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

#include "dynamic_filter/online.hpp"
#include "dynamic_filter/writers.hpp"
#include "run/label_store.hpp"
#include "support/room.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace run_view_test {

constexpr Label kStill = Label::static_, kDynamic = Label::dynamic, kUnknown = Label::unknown;

TEST(ScanNote, CountsVerdictsCorrectionsAndErrors) {
    const Labels final = {kStill, kDynamic, kUnknown, kDynamic, kStill},
                 instant = {kStill, kStill, kUnknown, kDynamic, kDynamic},
                 truth = {kStill, kDynamic, kUnknown, kStill, kDynamic};
    const ScanNote note = note_of(final, instant, truth);
    EXPECT_EQ(note.counts, (std::array<std::uint32_t, 3>{2, 2, 1}));
    EXPECT_EQ(note.corrected, 2U);
    EXPECT_EQ(note.scores, (std::array<std::uint32_t, 8>{1, 1, 1, 1, 1, 1, 1, 1}));
    EXPECT_EQ(note_of(final, {}, {}).corrected, UINT32_MAX);
}

template <class T>
std::vector<T> column(const PageRun& run, const std::string& name) {
    for (const PageArray& array : run.arrays) {
        if (array.name != name) continue;
        EXPECT_EQ(array.type, page_type<T>()) << name;
        std::vector<T> values(array.bytes.size() / sizeof(T));
        EXPECT_EQ(values.size(), array.rows * array.columns) << name;
        std::memcpy(values.data(), array.bytes.data(), array.bytes.size());
        return values;
    }
    ADD_FAILURE() << name << " is missing";
    return {};
}

/// A recording of a room with a walker on disk, run to its end.
class RunView : public testing::Test {
protected:
    RunView() {
        std::vector<Pose> poses;
        std::vector<double> stamps;
        for (std::size_t i = 0; i < scans_.size(); ++i) {
            const std::string stem = std::to_string(i);
            std::filesystem::create_directories(folder_ / "velodyne");
            io::write_bin(folder_ / ("velodyne/" + stem + ".bin"), scans_[i].scan.points,
                          std::vector<float>(scans_[i].scan.points.size(), 0.5F));
            poses.push_back(scans_[i].scan.T_world_sensor);
            stamps.push_back(scans_[i].scan.stamp);
        }
        std::string text, times;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const auto rows = poses[i].matrix();
            for (int k = 0; k < 12; ++k) text += std::to_string(rows(k / 4, k % 4)) + " ";
            text += "\n";
            times += std::to_string(stamps[i]) + "\n";
        }
        folder_.put("poses.txt", text);
        folder_.put("times.txt", times);
        recording_ = io::open_recording(folder_.path());
        for (std::size_t i = 0; i < recording_.size(); ++i) {
            io::FullScan full = recording_.read(i);
            filter_.push({full.points, full.T_world_sensor, full.stamp, i});
        }
        filter_.finish();
        for (std::size_t i = 0; i < recording_.size(); ++i) {
            const io::FullScan full = recording_.read(i);
            labels_.push_back(
                filter_.verdict({full.points, full.T_world_sensor, full.stamp, i}).labels);
            ScanNote note = note_of(labels_[i], instant_.get(i), {});
            note.index = i;
            note.position = full.T_world_sensor.translation();
            notes_.push_back(note);
        }
    }
    [[nodiscard]] ViewInput input() const {
        std::vector<std::size_t> all(recording_.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        ShownScans shown(all, recording_.size(),
                         [this](const Scan& scan) { return filter_.places_of(scan); });
        for (const std::size_t i : all) {
            shown.add(i, shown.draw(i, recording_.read(i), labels_[i], instant_.get(i), {}));
        }
        return {.recording = recording_,
                .scans = notes_,
                .sensors = {},
                .shown = shown.take(),
                .objects = {},
                .histories = [this](const auto& voxels) { return filter_.histories(voxels); },
                .keyframes = filter_.contents().keyframes,
                .has_evidence = true};
    }
    test::TemporaryFolder folder_;
    std::vector<test::RoomScan> scans_ = test::drive(12, true);
    LabelStore instant_{folder_.path()};
    io::Recording recording_;
    OnlineFilter filter_{Config{},
                         {.overload = Overload::wait, .horizon = 0.0, .max_bytes = 0},
                         {.instant = [this](const Verdict& v) { instant_.put(v.index, v.labels); },
                          .settled = {},
                          .notice = {}}};
    std::vector<Labels> labels_;  // final, by scan
    std::vector<ScanNote> notes_;
};

TEST_F(RunView, HoldsEveryPointWhereThereIsRoom) {
    const PageRun run = view_of(input());
    std::size_t points = 0;
    for (const auto& s : scans_) points += s.scan.points.size();
    EXPECT_EQ(run.info["points_total"], points);
    const auto begin = column<std::uint32_t>(run, "frame-begin");
    ASSERT_EQ(begin.size(), scans_.size() + 1);
    const auto position = column<std::uint16_t>(run, "frame-position");
    const auto verdict = column<std::uint8_t>(run, "frame-verdict");
    ASSERT_EQ(position.size(), 3 * verdict.size());
    ASSERT_EQ(begin.back(), points);
    const double step = run.info["step"];
    for (std::size_t s = 0; s < scans_.size(); ++s) {
        const Scan& scan = scans_[s].scan;
        const Labels& labels = labels_[s];
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            const Eigen::Vector3d world = scan.T_world_sensor * scan.points[i].cast<double>();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double shown = run.info["origin"][axis].get<double>() +
                                     run.info["low"][axis].get<double>() +
                                     step * position[3 * (begin[s] + i) + axis];
                ASSERT_NEAR(shown, world[static_cast<int>(axis)], 0.51 * step + 1e-3);
            }
            const unsigned code = labels[i] == kDynamic ? 2 : labels[i] == kStill ? 1 : 0;
            ASSERT_EQ(verdict[begin[s] + i] & 3U, code);
            ASSERT_EQ(verdict[begin[s] + i] >> 2U & 3U, 3U);  // no truth
        }
    }
}

TEST_F(RunView, ListsWhatMoved) {
    ViewInput in = input();
    const Eigen::Vector3d place = notes_[3].position + Eigen::Vector3d(1, 2, 0);
    in.objects.push_back({.object = 4,
                          .first = 3,
                          .last = 9,
                          .nearest = 5,
                          .points = 120,
                          .size = {4, 2, 1.5},
                          .path = 7.5,
                          .fastest = 2,
                          .places = {{3, place, {4, 2, 1.5}}}});
    in.objects_total = 2;
    const PageRun run = view_of(in);
    EXPECT_EQ(run.info["objects_total"], 2);
    EXPECT_EQ(column<std::uint32_t>(run, "object-number"), (std::vector<std::uint32_t>{4}));
    EXPECT_EQ(column<std::uint32_t>(run, "object-row"), (std::vector<std::uint32_t>{3, 9, 5}));
    EXPECT_EQ(column<float>(run, "object-facts"), (std::vector<float>{120, 4, 2, 1.5, 7.5, 2}));
    EXPECT_EQ(column<std::uint32_t>(run, "object-begin"), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(column<std::uint32_t>(run, "object-place-row"), (std::vector<std::uint32_t>{3}));
    const auto at = column<float>(run, "object-place");
    const auto path = column<float>(run, "path-position");
    EXPECT_NEAR(at[0] - path[9], 1.0, 1e-4);
    EXPECT_NEAR(at[1] - path[10], 2.0, 1e-4);
}

TEST_F(RunView, SaysWhyAPointIsGone) {
    const PageRun run = view_of(input());
    const auto verdict = column<std::uint8_t>(run, "map-verdict");
    const auto voxel = column<std::uint32_t>(run, "map-voxel");
    const auto probability = column<std::uint8_t>(run, "voxel-probability");
    const auto evidence = column<std::uint16_t>(run, "voxel-evidence");
    const auto span = column<std::uint32_t>(run, "voxel-span");
    const auto begin = column<std::uint32_t>(run, "pass-begin");
    const auto pass = column<std::uint16_t>(run, "pass");
    const std::vector<std::uint32_t> keyframes = run.info["keyframes"];
    ASSERT_EQ(begin.size(), probability.size() + 1);
    ASSERT_EQ(evidence.size(), 4 * probability.size());
    const auto score = column<float>(run, "voxel-score");
    ASSERT_EQ(score.size(), 3 * probability.size());
    ASSERT_EQ(begin.back(), pass.size());
    std::size_t removed = 0;
    for (std::size_t i = 0; i < verdict.size(); ++i) {
        if ((verdict[i] & 3U) != 2U) continue;
        const std::uint32_t v = voxel[i];
        ASSERT_LT(v, probability.size());
        EXPECT_LE(span[2 * v], span[2 * v + 1]);
        EXPECT_LE(evidence[4 * v + 1], scans_.size());
        EXPECT_LE(score[3 * v], static_cast<float>(evidence[4 * v + 1]));
        for (std::uint32_t k = begin[v]; k < begin[v + 1]; ++k) {
            ASSERT_LT(pass[k], keyframes.size());
            EXPECT_LT(keyframes[pass[k]], scans_.size());
        }
        if (begin[v + 1] > begin[v]) ++removed;
    }
    EXPECT_GT(removed, 10U);
}

TEST_F(RunView, IsTheSameEveryTime) {
    EXPECT_EQ(embedded(view_of(input()), 0), embedded(view_of(input()), 0));
}

TEST(CloudView, IsStaticAndWithoutARun) {
    io::Cloud cloud;
    io::add_field(cloud, "x", io::FieldType::f32);
    io::add_field(cloud, "y", io::FieldType::f32);
    io::add_field(cloud, "z", io::FieldType::f32);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> records = {100.0F, 200.0F, 3.0F, 101.0F, 205.0F,
                                        4.0F,   nan,    0.0F, 0.0F};
    cloud.data.resize(records.size() * sizeof(float));
    std::memcpy(cloud.data.data(), records.data(), cloud.data.size());
    const PageRun run = view_of(cloud);
    EXPECT_EQ(run.info["scans"], 0);
    EXPECT_EQ(run.info["points_total"], 3);
    EXPECT_EQ(run.info["points_shown"], 2);
    for (const std::uint8_t code : column<std::uint8_t>(run, "map-verdict")) {
        EXPECT_EQ(code & 3U, 1U);
    }
}

TEST_F(RunView, TellsTheSensorOfEachScan) {
    EXPECT_FALSE(view_of(input()).info.contains("groups"));
    for (std::size_t i = 0; i < notes_.size(); ++i) notes_[i].sensor = i % 2;
    ViewInput in = input();
    in.sensors = {"front", "rear"};
    const PageRun run = view_of(in);
    EXPECT_EQ(run.info["groups"]["kind"], "sensor");
    EXPECT_EQ(run.info["groups"]["names"], (std::vector<std::string>{"front", "rear"}));
    const auto sensors = column<std::uint8_t>(run, "path-sensor");
    ASSERT_EQ(sensors.size(), notes_.size());
    for (std::size_t i = 0; i < sensors.size(); ++i) EXPECT_EQ(sensors[i], i % 2);
}

}  // namespace run_view_test
}  // namespace dynamic_filter::app
