// SPDX-License-Identifier: MIT
#include "support/recording.hpp"

#include <cmath>

namespace dynamic_filter::io {
namespace recording_test {

using RecordingTest = RecordingFiles;

TEST_F(RecordingTest, ScanPoseStampAndTruth) {
    put_bins("velodyne", 2);
    put_labels(2);
    data.put("poses.txt", kitti_rows(2));
    const FullScan scan = open().read(1);
    EXPECT_EQ(scan.points, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(scan.T_world_sensor.translation().x(), 1.0);
    EXPECT_DOUBLE_EQ(scan.stamp, 0.1);
    EXPECT_EQ(scan.truth, (Labels{Label::dynamic, Label::static_}));
    EXPECT_EQ(column(scan.cloud, "intensity"), (std::vector<double>{0.5, 0.5}));
}

TEST_F(RecordingTest, UnusableScansAreRejectedOneByOne) {
    put_bins("velodyne", 4);
    put_labels(4);
    data.put("poses.txt", kitti_rows(3) + "nan nan nan nan 0 0 0 0 0 0 0 0\n");
    data.put("velodyne/000000.bin", "");
    data.put("velodyne/000001.bin", floats({1, 2, 3}));
    data.put("labels/000002.label", std::string(12, '\0'));
    const Recording recording = open();
    const auto error = [&](std::size_t i) { return error_of([&] { (void)recording.read(i); }); };
    EXPECT_HAS(error(0), "empty");
    EXPECT_HAS(error(1), "12 bytes");
    // Truth decides nothing.
    EXPECT_EQ(recording.read(2).points, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_HAS(error(3), "not finite");
}

TEST_F(RecordingTest, TruthThatDoesNotFitTakesNothingFromItsScan) {
    put_bins("velodyne", 3);
    put_labels(3);
    data.put("poses.txt", kitti_rows(3));
    data.put("labels/000001.label", std::string(12, '\0'));
    data.put("labels/000002.label", "123");
    const Recording recording = open();
    EXPECT_EQ(recording.read(0).truth_fault, "");
    for (const std::size_t i : {1U, 2U}) {
        const FullScan scan = recording.read(i);
        EXPECT_EQ(scan.points, (Points{{1, 2, 3}, {4, 5, 6}}));
        EXPECT_TRUE(scan.truth.empty());
    }
    EXPECT_HAS(recording.read(1).truth_fault, "3 labels but 2 points");
    EXPECT_HAS(recording.read(1).truth_fault, "000001.label");
    EXPECT_HAS(recording.read(2).truth_fault, "no multiple of 4");
}

TEST_F(RecordingTest, WhatShowsWithoutReadingIsWhatReadingSays) {
    put_bins("scans", 4);
    data.put("poses.txt", kitti_rows(3) + "nan nan nan nan 0 0 0 0 0 0 0 0\n");
    data.put("scans/000000.bin", "");
    data.put("scans/000001.bin", floats({1, 2, 3}));
    const Recording recording = open();
    for (const std::size_t i : {0U, 1U, 3U}) {
        const std::string quick = error_of([&] { recording.check(i); });
        EXPECT_NE(quick, "") << i;
        EXPECT_EQ(quick, error_of([&] { (void)recording.read(i); }));
    }
    EXPECT_NO_THROW(recording.check(2));
}

TEST_F(RecordingTest, NoPoints) {
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    write_pcd(data / "a.pcd", cloud);
    data.put("poses.txt", kitti_rows(1));
    EXPECT_HAS(error_of([&] { (void)open().read(0); }), "no points");
}

TEST_F(RecordingTest, LabelsAreSemanticKitti) {
    std::string bytes;
    for (const std::uint32_t raw : {0U, 1U, 9U, 40U, 250U, 251U, 259U, 260U, 252U | 3U << 16U}) {
        bytes += bytes_of(raw);
    }
    const Labels labels = read_labels(data.put("a.label", bytes));
    const auto u = Label::unknown, s = Label::static_, d = Label::dynamic;
    EXPECT_EQ(labels, (Labels{u, u, s, s, s, d, d, s, d}));
    EXPECT_HAS(error_of([&] { read_labels(data.put("a.label", "12345")); }), "byte 4");
}

TEST_F(RecordingTest, AScanWithoutAMeasurementOrWithAnAbsurdPoseIsRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    put_bins("velodyne", 2);
    data.put("velodyne/000000.bin", floats({nan, 1, 1, 0, 0, 0, 0, 1}));
    data.put("poses.txt", kitti_rows(1) + "1 0 0 1e20 0 1 0 0 0 0 1 0\n");
    const Recording recording = open();
    EXPECT_HAS(error_of([&] { (void)recording.read(0); }), "no finite point");
    EXPECT_HAS(error_of([&] { (void)recording.read(1); }), "metres");
}

TEST_F(RecordingTest, BeamsWithoutReturnAreNoMeasurements) {
    std::string bytes;
    for (int i = 0; i < 100; ++i) {
        const double elevation = 0.001 * i;
        bytes += floats({static_cast<float>(100.0 * std::cos(elevation)), 0.0F,
                         static_cast<float>(100.0 * std::sin(elevation)), 0.0F});
        bytes += floats({5.0F, 0.1F * static_cast<float>(i), 0.0F, 0.0F});
    }
    data.put("velodyne/0.bin", bytes);
    data.put("poses.txt", kitti_rows(1));
    const FullScan scan = open().read(0);
    EXPECT_EQ(scan.no_returns, 100U);
    EXPECT_FALSE(is_measured(scan.points[0]));
    EXPECT_TRUE(is_measured(scan.points[1]));
    EXPECT_EQ(column(scan.cloud, "x")[0], 100.0);
}

}  // namespace recording_test
}  // namespace dynamic_filter::io
