// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/matrix.hpp"
#include "recording/layouts/pose_notes.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* cloud_name = "cloud.pcd";
constexpr const char* data_name = "data";

/// A keyframe of the graph.
struct HdlKeyframe {
    std::optional<Pose> estimate, odom;
    std::optional<double> stamp;
};

/// Converts "1500000000 200000000" (seconds and nanoseconds) to seconds.
double stamp_in(std::string_view text, const Lines& lines) {
    const auto tokens = split_tokens(text);
    const auto seconds = tokens.size() == 2 ? parse_real(tokens[0]) : std::nullopt;
    const auto nanoseconds = tokens.size() == 2 ? parse_real(tokens[1]) : std::nullopt;
    if (!seconds || !nanoseconds) {
        lines.fail(quote(trim(text)) + " is no stamp; expected seconds and nanoseconds");
    }
    return *seconds + *nanoseconds * 1e-9;
}

HdlKeyframe read_keyframe(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    HdlKeyframe keyframe;
    while (lines.next()) {
        std::string_view rest = lines.line();
        const std::string_view key = next_token(rest);
        if (key == "estimate") keyframe.estimate = read_matrix(lines);
        if (key == "odom") keyframe.odom = read_matrix(lines);
        if (key == "stamp") keyframe.stamp = stamp_in(rest, lines);
    }
    if (keyframe.estimate || keyframe.odom) return keyframe;
    throw InputError(file, "",
                     "has neither 'estimate' nor 'odom', a 4x4 matrix in the lines below it");
}

/// True for NNNNNN with a cloud and its pose.
bool is_keyframe(const fs::path& folder) {
    const std::string name = folder.filename().string();
    return std::all_of(name.begin(), name.end(), is_digit) && present(folder / cloud_name) &&
           present(folder / data_name);
}

}  // namespace

std::optional<Layout> find_hdl(const Place& place) {
    if (prefers_other_poses(place)) return std::nullopt;
    Layout layout;
    layout.scan_folder = place.data;
    layout.read = [](const fs::path& folder) { return read_cloud(folder / cloud_name); };
    std::size_t of_odometry = 0;
    for (const fs::path& folder : list_folders(place.data)) {
        if (!is_keyframe(folder)) continue;
        const HdlKeyframe keyframe = read_keyframe(folder / data_name);
        layout.scans.push_back(folder);
        layout.T_world_sensor.push_back(keyframe.estimate ? *keyframe.estimate : *keyframe.odom);
        if (!keyframe.estimate) ++of_odometry;
        if (keyframe.stamp) layout.stamps.push_back(*keyframe.stamp);
    }
    if (layout.scans.empty()) return std::nullopt;
    if (layout.stamps.size() != layout.scans.size()) layout.stamps.clear();
    if (has_given_poses(layout, place)) {
        layout.T_world_sensor.clear();
        return layout;
    }
    layout.notes.push_back("poses from the file `data` beside each cloud: " +
                           std::to_string(layout.scans.size() - of_odometry) + " of `estimate`, " +
                           std::to_string(of_odometry) + " of `odom`");
    note_lost(layout);
    return layout;
}

}  // namespace dynamic_filter::io
