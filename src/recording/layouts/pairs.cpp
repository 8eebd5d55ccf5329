// SPDX-License-Identifier: MIT
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/matrix.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

Pose read_odom(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    const Pose pose = read_matrix(lines);
    while (lines.next()) {
        if (!trim(lines.line()).empty()) lines.fail("more than the four rows of a 4x4 matrix");
    }
    return pose;
}

/// Converts "1500000000_200000000" (seconds and nanoseconds) to seconds.
std::optional<double> stamp_of(const std::string& stem) {
    const std::size_t line = stem.find('_');
    if (line == std::string::npos) return std::nullopt;
    const auto seconds = parse_real(stem.substr(0, line));
    const auto nanoseconds = parse_real(stem.substr(line + 1));
    const bool digits = stem.find_first_not_of("0123456789_") == std::string::npos;
    if (!digits || !seconds || !nanoseconds) return std::nullopt;
    return *seconds + *nanoseconds * 1e-9;
}

fs::path other_half(const fs::path& file, const char* extension) {
    fs::path other = file;
    other.replace_extension(extension);
    if (present(other)) return other;
    throw InputError(file, "",
                     "has no " + other.filename().string() + " beside it; each scan needs both");
}

}  // namespace

std::optional<Layout> find_pairs(const Place& place) {
    if (prefers_other_poses(place)) return std::nullopt;
    std::error_code ignored;
    const Paths odometry = list_files(place.data, {".odom"}, ignored);
    if (odometry.empty()) return std::nullopt;
    Layout layout;
    layout.scan_folder = place.data;
    layout.scans = list_files(place.data, {".pcd"});
    for (const fs::path& file : odometry) (void)other_half(file, ".pcd");
    for (const fs::path& scan : layout.scans) {
        if (const auto stamp = stamp_of(scan.stem().string())) layout.stamps.push_back(*stamp);
    }
    if (layout.stamps.size() != layout.scans.size()) layout.stamps.clear();
    if (has_given_poses(layout, place)) return layout;
    for (const fs::path& scan : layout.scans) {
        layout.T_world_sensor.push_back(read_odom(other_half(scan, ".odom")));
    }
    layout.notes.emplace_back("poses from the .odom file beside each scan");
    return layout;
}

}  // namespace dynamic_filter::io
