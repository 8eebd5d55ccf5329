// SPDX-License-Identifier: MIT
/// clean_folder RECORDING OUT: a verdict for every point of every scan, and the map without what
/// moves.
#include <cstdio>
#include <dynamic_filter/dynamic_filter.hpp>
#include <dynamic_filter/recording.hpp>
#include <dynamic_filter/writers.hpp>
#include <exception>

namespace df = dynamic_filter;

namespace {

df::Scan scan_of(const df::io::FullScan& full, std::size_t index) {
    return {full.points, full.T_world_sensor, full.stamp, index};
}

void append(df::io::Cloud& map, const df::Point& in_world) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(in_world.data());
    map.data.insert(map.data.end(), bytes, bytes + map.point_bytes);
}

void clean(const std::filesystem::path& data, const std::filesystem::path& out) {
    const df::io::Recording recording = df::io::open_recording(data);
    df::DynamicFilter filter{df::Config{}};
    for (std::size_t i = 0; i < recording.size(); ++i) {
        filter.push(scan_of(recording.read(i), i));
    }
    filter.finish();

    // The filter keeps no scans: they are read once more, for the final verdicts.
    df::io::Cloud map;
    for (const char* const axis : {"x", "y", "z"}) {
        df::io::add_field(map, axis, df::io::FieldType::f32);
    }
    std::filesystem::create_directories(out / "labels");
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const df::Scan scan = scan_of(recording.read(i), i);
        const df::Labels labels = filter.verdict(scan).labels;
        df::io::write_labels(out / "labels" / (df::io::stem(recording, i) + ".label"), labels);
        for (std::size_t p = 0; p < labels.size(); ++p) {
            if (labels[p] == df::Label::dynamic) continue;
            append(map, (scan.T_world_sensor * scan.points[p].cast<double>()).cast<float>());
        }
    }
    df::io::write_pcd(out / "static_map.pcd", map);
    std::printf("%zu scans, %zu points stay\n", recording.size(), map.size());
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 3) throw df::Error("usage: clean_folder RECORDING OUT");
    clean(argv[1], argv[2]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
