// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/io/file.hpp"
#include "frames.hpp"
#include "report.hpp"

namespace dynamic_filter::app {

namespace {

eval::Scores score_label_folder(const io::Sequence& sequence, const Eigen::Vector3d& origin,
                                const std::filesystem::path& folder, double voxel) {
    // Given the output folder of a run, its labels are meant.
    const auto labels =
        std::filesystem::is_directory(folder / "labels") ? folder / "labels" : folder;
    std::size_t missing = 0;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        const auto file = labels / (io::stem(sequence, i) + ".label");
        if (!std::filesystem::exists(file)) {
            ++missing;
            continue;
        }
        const std::size_t truth = io::read_frame(sequence, i).truth.size();
        const std::size_t given = io::read_labels(file).size();
        if (truth != given) {
            throw InputError(file, "",
                             fmt::format("{} labels, but the scan has {} points", given, truth));
        }
    }
    if (missing == sequence.size()) {
        throw InputError(labels, "",
                         "holds no label file of any scan in " + sequence.root.string());
    }
    if (missing > 0)
        fmt::print(stderr, "note: {} scans have no label file and are left out\n", missing);
    const auto labels_of = [&](std::size_t i) -> std::optional<Labels> {
        const auto file = labels / (io::stem(sequence, i) + ".label");
        if (!std::filesystem::exists(file)) return std::nullopt;
        return io::read_labels(file);
    };
    return eval::score_labels(sequence.size(), scan_source(sequence, origin, labels_of), voxel);
}

eval::Scores score_map_file(const io::Sequence& sequence, const Eigen::Vector3d& origin,
                            const std::filesystem::path& file, double voxel) {
    Points map = io::positions(io::read_cloud(file));
    for (Point& p : map) p = (p.cast<double>() - origin).cast<float>();
    return eval::score_map(sequence.size(), scan_source(sequence, origin, {}), map, voxel);
}

}  // namespace

int evaluate(const EvalOptions& o) {
    const io::Sequence sequence = open(o.truth, o.format, o.poses);
    if (!sequence.has_truth()) {
        throw InputError(o.truth, "", "has no ground truth (labels/*.label, or 0/1 intensities)");
    }
    const Eigen::Vector3d origin = scoring_origin(sequence, o.voxel);
    const eval::Scores scores = o.labels ? score_label_folder(sequence, origin, *o.labels, o.voxel)
                                         : score_map_file(sequence, origin, *o.map, o.voxel);
    fmt::print("{}", table(scores));
    if (o.json) io::write_file(*o.json, to_json(scores).dump(2) + "\n");
    return kDone;
}

}  // namespace dynamic_filter::app
