// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/input.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/matrix.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* points_name = "points_compact.bin";
constexpr const char* intensities_name = "intensities_compact.bin";
constexpr std::size_t position_bytes = 3 * sizeof(float);

struct Submap {
    std::optional<Pose> T_world_origin;
    std::vector<double> stamps;  ///< [s] stamps of its frames
};

Submap read_data(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    Submap submap;
    while (lines.next()) {
        std::string_view rest = lines.line();
        const std::string_view key = next_token(rest);
        if (key == "T_world_origin:") {
            submap.T_world_origin = read_matrix(lines);
        } else if (key == "stamp:") {
            const auto stamp = parse_real(trim(rest));
            if (!stamp) lines.fail(quote(rest) + " is no stamp");
            submap.stamps.push_back(*stamp);
        }
    }
    if (!submap.T_world_origin) throw InputError(file, "", "has no T_world_origin");
    return submap;
}

bool is_submap(const fs::path& folder) {
    const std::string name = folder.filename().string();
    return name.find_first_not_of("0123456789") == std::string::npos &&
           present(folder / "data.txt") && present(folder / points_name);
}

}  // namespace

std::optional<Layout> find_glim(const Place& place) {
    if (prefers_other_poses(place)) return std::nullopt;
    Layout layout;
    layout.scan_folder = place.data;
    layout.read = read_submap;
    for (const fs::path& folder : list_folders(place.data)) {
        if (!is_submap(folder)) continue;
        const Submap submap = read_data(folder / "data.txt");
        layout.scans.push_back(folder);
        layout.T_world_sensor.push_back(*submap.T_world_origin);
        // The origin of a submap is at its middle frame.
        if (!submap.stamps.empty())
            layout.stamps.push_back(submap.stamps[submap.stamps.size() / 2]);
    }
    if (layout.scans.empty()) return std::nullopt;
    if (layout.stamps.size() != layout.scans.size()) layout.stamps.clear();
    layout.notes.emplace_back(
        "GLIM's submaps are taken as scans seen from their origins; they were merged from scans "
        "of several places, so prefer the scans themselves if you have them");
    if (has_given_poses(layout, place)) layout.T_world_sensor.clear();
    return layout;
}

Cloud read_submap(const fs::path& folder) {
    const std::vector<std::byte> points = read_bytes(folder / points_name);
    if (points.size() % position_bytes != 0) {
        throw InputError(folder / points_name, fmt::format("byte {}", points.size()),
                         "its size is no multiple of 12 (float32 x y z); it is truncated");
    }
    const std::size_t count = points.size() / position_bytes;
    const bool has_intensity = present(folder / intensities_name);
    std::vector<std::byte> intensities;
    if (has_intensity) intensities = read_bytes(folder / intensities_name);
    if (has_intensity && intensities.size() != count * sizeof(float)) {
        throw InputError(folder / intensities_name, "",
                         fmt::format("{} bytes; {} points need {} (float32)", intensities.size(),
                                     count, count * sizeof(float)));
    }
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    if (has_intensity) add_field(cloud, "intensity", FieldType::f32);
    cloud.data.reserve(points.size() + intensities.size());
    const auto append = [&](const std::vector<std::byte>& from, std::size_t i, std::size_t size) {
        const auto* begin = from.data() + i * size;
        cloud.data.insert(cloud.data.end(), begin, begin + size);
    };
    for (std::size_t i = 0; i < count; ++i) {
        append(points, i, position_bytes);
        if (has_intensity) append(intensities, i, sizeof(float));
    }
    return cloud;
}

}  // namespace dynamic_filter::io
