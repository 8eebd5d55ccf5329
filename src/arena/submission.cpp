// SPDX-License-Identifier: MIT
#include "arena/submission.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <span>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/label_files.hpp"
#include "geometry/neighbor_grid.hpp"
#include "recording/folders.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

Labels labels_for(const io::FullScan& scan, const fs::path& file) {
    Labels labels = io::read_labels(file);
    if (labels.size() == scan.points.size()) return labels;
    throw InputError(file, "",
                     fmt::format("has {} labels, but the scan has {} points", labels.size(),
                                 scan.points.size()));
}

/// The number of the sequence by which SemanticKITTI's scorer knows the entry.
std::string sequence_of(const std::string& entry) {
    static const std::map<std::string, std::string> sensors = {
        {"Aeva", "00"}, {"Avia", "01"}, {"Ouster", "02"}, {"Velodyne", "03"}};
    const auto found = sensors.find(entry);
    return found == sensors.end() ? entry : found->second;
}

/// sequences/NN/predictions/*.label of the scans with ground truth. The scorer takes 0 for a miss,
/// so what is unknown is static.
void write_predictions(const Trial& trial, const io::Recording& recording, const fs::path& labels,
                       const fs::path& folder) {
    const fs::path to = folder / "sequences" / sequence_of(trial.entry) / "predictions";
    fs::create_directories(to);
    for (const std::size_t i : trial.scored.empty() ? all_scans(recording) : trial.scored) {
        const std::string stem = io::stem(recording, i);
        Labels found = labels_for(recording.read(i), io::label_file(labels, stem));
        for (Label& label : found) {
            if (label == Label::unknown) label = Label::static_;
        }
        io::write_labels(io::label_file(to, stem), found, io::Durable::contents);
    }
    io::sync_folder(to);
}

/// The points of the files that are not labelled dynamic, without the ground truth in the
/// intensity.
io::Cloud clean_map(const io::Recording& recording, const fs::path& labels) {
    io::Cloud map;
    for (const char* name : {"x", "y", "z", "intensity"}) {
        io::add_field(map, name, io::FieldType::f32);
    }
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const io::FullScan scan = recording.read(i);
        const Labels found = labels_for(scan, io::label_file(labels, io::stem(recording, i)));
        const Points world = io::positions(scan.cloud);
        for (std::size_t p = 0; p < world.size(); ++p) {
            if (found[p] == Label::dynamic || !world[p].allFinite()) continue;
            const std::array record{world[p].x(), world[p].y(), world[p].z(), 0.0F};
            const auto bytes = std::as_bytes(std::span(record));
            map.data.insert(map.data.end(), bytes.begin(), bytes.end());
        }
    }
    return map;
}

/// NN/dynamicfilter_output.pcd, and what the benchmark's export_eval_pcd makes of it: all points of
/// the truth in their order, with intensity 1 where the map has nothing within 0.05 m.
void write_clean_map(const Trial& trial, const io::Recording& recording, const fs::path& labels,
                     const fs::path& folder) {
    const io::Cloud map = clean_map(recording, labels);
    const fs::path to = folder / trial.entry;
    if (map.size() == 0) throw InputError(labels, "", "label no point static");
    fs::create_directories(to / "eval");
    io::write_pcd(to / "dynamicfilter_output.pcd", map);
    const fs::path truth = trial.data.data / "gt_cloud.pcd";
    if (!io::present(truth)) return;
    const NeighborGrid grid(io::positions(map), 0.1F);
    io::Cloud exported = map;
    exported.data.clear();
    for (const Point& point : io::positions(io::read_cloud(truth))) {
        const std::array record{point.x(), point.y(), point.z(),
                                grid.any_within(point, 0.05F) ? 0.0F : 1.0F};
        const auto bytes = std::as_bytes(std::span(record));
        exported.data.insert(exported.data.end(), bytes.begin(), bytes.end());
    }
    io::write_pcd(to / "eval" / "dynamicfilter_output_exportGT.pcd", exported);
}

}  // namespace

void refuse_without_submission(const Arena& arena) {
    for (const char* name : {"mos", "helimos", "dynamicmap"}) {
        if (arena.name == name) return;
    }
    throw ConfigError(arena.name +
                      " asks for no files; --submission is for mos, helimos and "
                      "dynamicmap");
}

void write_submission(const Arena& arena, const Trial& trial, const io::Recording& recording,
                      const fs::path& labels, const fs::path& folder) {
    if (arena.name == "dynamicmap") {
        write_clean_map(trial, recording, labels, folder);
    } else {
        write_predictions(trial, recording, labels, folder);
    }
}

}  // namespace dynamic_filter::app
