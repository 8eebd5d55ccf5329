// SPDX-License-Identifier: MIT
/// evaluate RECORDING: how good the verdicts are, where the recording has ground truth.
#include <cstdio>
#include <dynamic_filter/dynamic_filter.hpp>
#include <dynamic_filter/recording.hpp>
#include <dynamic_filter/scores.hpp>
#include <exception>

namespace df = dynamic_filter;

namespace {

df::Scan scan_of(const df::io::FullScan& scan, std::size_t index) {
    return {scan.points, scan.T_world_sensor, scan.stamp, index};
}

void evaluate(const df::io::Recording& recording) {
    if (!recording.info().has_truth()) throw df::Error("this recording has no ground truth");
    df::Config config;
    config.map.voxel_size = 0.2;  // [m], as any setting: see settings.hpp
    df::DynamicFilter filter(config);
    for (std::size_t i = 0; i < recording.size(); ++i) {
        filter.push(scan_of(recording.read(i), i));
    }
    filter.finish();

    const auto judged = [&](std::size_t i) -> std::optional<df::eval::LabelledScan> {
        df::io::FullScan scan = recording.read(i);
        df::Labels verdict = filter.verdict(scan_of(scan, i)).labels;
        for (df::Point& p : scan.points) {
            p = (scan.T_world_sensor * p.cast<double>()).cast<float>();
        }
        return df::eval::LabelledScan{std::move(scan.points), std::move(scan.truth),
                                      std::move(verdict)};
    };
    const df::eval::Scores scores =
        df::eval::score_labels(recording.size(), judged, df::eval::kVoxelSize);
    const df::eval::VoxelScore& voxel = scores.voxel.at("excluded");
    std::printf("PR %.4f  RR %.4f  F1 %.4f  IoU of what moves %.4f\n", voxel.pr.value_or(0.0),
                voxel.rr.value_or(0.0), voxel.f1.value_or(0.0), scores.point.iou.value_or(0.0));
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) throw df::Error("usage: evaluate RECORDING");
    evaluate(df::io::open_recording(argv[1]));
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
