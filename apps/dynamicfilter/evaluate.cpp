// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/io/file.hpp"
#include "frames.hpp"
#include "report.hpp"

namespace dynamic_filter::app {

namespace {

/// Notes which scans give nothing.
eval::ScanSource noting(eval::ScanSource source, std::vector<std::atomic<bool>>& left_out) {
    return [source = std::move(source), &left_out](std::size_t i) {
        auto scan = source(i);
        left_out[i] = !scan.has_value();
        return scan;
    };
}

eval::ScanSource with_labels(const io::Sequence& sequence, const Eigen::Vector3d& origin,
                             const std::filesystem::path& folder) {
    // Given the output folder of a run, its labels are meant.
    const auto labels =
        std::filesystem::is_directory(folder / "labels") ? folder / "labels" : folder;
    if (!std::filesystem::is_directory(labels)) throw InputError(labels, "", "is not a folder");
    return scan_source(sequence, origin,
                       [&sequence, labels](std::size_t i) -> std::optional<Labels> {
                           const auto file = labels / (io::stem(sequence, i) + ".label");
                           if (!std::filesystem::exists(file)) return std::nullopt;
                           return io::read_labels(file);
                       });
}

/// Where the recording has no poses, those that the run found.
io::Sequence with_poses(const EvalOptions& o) {
    io::Sequence sequence = open(o.truth);
    if (sequence.has_poses) return sequence;
    const std::filesystem::path labels = o.labels.value_or("");
    for (const auto& file : {labels / "poses.txt", labels.parent_path() / "poses.txt"}) {
        if (!o.labels || !std::filesystem::exists(file)) continue;
        DataOptions with = o.truth;
        with.open.poses = file;
        return open(with);
    }
    throw InputError(o.truth.data, "",
                     "has no poses, so its voxels cannot be scored; give those of the run with "
                     "--poses");
}

}  // namespace

Evaluation scores_of(const EvalOptions& o) {
    const io::Sequence sequence = with_poses(o);
    if (!sequence.has_truth()) {
        throw InputError(o.truth.data, "",
                         "has no ground truth (labels/*.label, or 0/1 intensities)");
    }
    const Eigen::Vector3d origin = scoring_origin(sequence, o.voxel);
    std::vector<std::atomic<bool>> left_out(sequence.size());
    const eval::ScanSource source = noting(
        o.labels ? with_labels(sequence, origin, *o.labels) : scan_source(sequence, origin, {}),
        left_out);
    eval::Scores scores =
        o.labels ? eval::score_labels(sequence.size(), source, o.voxel)
                 : eval::score_map(sequence.size(), source,
                                   positions_from(io::read_cloud(*o.map), origin), o.voxel);
    const auto missing =
        static_cast<std::size_t>(std::count(left_out.begin(), left_out.end(), true));
    if (missing == sequence.size()) {
        throw InputError(o.labels ? *o.labels : o.truth.data, "",
                         "holds no label file of any readable scan in " + o.truth.data.string());
    }
    return {std::move(scores), sequence.size(), missing};
}

int evaluate(const EvalOptions& o) {
    const Evaluation e = scores_of(o);
    fmt::print("{}", table(e.scores));
    if (o.json) io::write_file(*o.json, text_of(to_json(e.scores)));
    if (e.left_out == 0) return kDone;
    fmt::print(stderr, "left out {} of {} scans: unreadable, or without labels\n", e.left_out,
               e.scans);
    return kRejected;
}

}  // namespace dynamic_filter::app
