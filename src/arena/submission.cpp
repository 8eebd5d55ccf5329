// SPDX-License-Identifier: MIT
#include "arena/submission.hpp"

#include <fmt/format.h>

#include <map>

#include "arena/score_trial.hpp"
#include "arena/truth_cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/label_files.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

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
    for (const std::size_t i : scored_scans(trial, recording)) {
        const std::string stem = io::stem(recording, i);
        Labels found = verdict_of(labels, recording, i, recording.read(i).points.size());
        for (Label& label : found) {
            if (label == Label::unknown) label = Label::static_;
        }
        io::write_labels(io::label_file(to, stem), found, io::Durable::contents);
    }
    io::sync_folder(to);
}

/// NN/dynamicfilter_output.pcd, and what the benchmark's export_eval_pcd makes of it: all points of
/// the truth in their order, with intensity 1 where the map has nothing within 0.05 m.
void write_clean_map(const Trial& trial, const io::Recording& recording, const fs::path& labels,
                     const fs::path& folder) {
    const io::Cloud map = clean_cloud(recording, labels);
    const fs::path to = folder / trial.entry;
    fs::create_directories(to / "eval");
    io::write_pcd(to / "dynamicfilter_output.pcd", map);
    const Points truth = io::positions(truth_cloud(trial, recording));
    const std::vector<char> is_kept = near_map(truth, io::positions(map));
    io::Cloud exported;
    exported.fields = map.fields;
    exported.point_bytes = map.point_bytes;
    for (std::size_t p = 0; p < truth.size(); ++p) {
        put_point(exported, truth[p], is_kept[p] != 0 ? 0.0F : 1.0F);
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
