// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/exit_code.hpp"
#include "base/json_vector.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/evaluate.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "export/part.hpp"
#include "formats/knowable_file.hpp"
#include "formats/label_files.hpp"
#include "recording/data_options.hpp"
#include "recording/recording_parts.hpp"
#include "recording/scans.hpp"
#include "recording/truth.hpp"
#include "run/open_for_result.hpp"
#include "run/scored_scans.hpp"
#include "score/erasor_maps.hpp"
#include "score/knowable_report.hpp"
#include "score/protocols.hpp"
#include "score/report.hpp"
#include "score/scored_part.hpp"

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

eval::ScanSource with_labels(const io::Recording& recording, const Eigen::Vector3d& origin,
                             const std::filesystem::path& folder, const ScoredPart& part) {
    // Given the output folder of a run, its labels are meant.
    const auto labels = io::label_folder(folder);
    if (!std::filesystem::is_directory(labels)) throw InputError(labels, "", "is not a folder");
    const auto labels_of = [&recording, labels](std::size_t i) -> std::optional<Labels> {
        const auto file = io::label_file(labels, io::stem(recording, i));
        if (!std::filesystem::exists(file)) return std::nullopt;
        return io::read_labels(file);
    };
    return scan_source(recording, origin, labels_of, part);
}

/// Nothing if the recording tells nothing of what could be known.
std::optional<eval::KnowableScores> knowable_scores(const EvalOptions& o,
                                                    const io::Recording& recording,
                                                    const eval::ScanSource& source) {
    const auto folder = io::knowable_folder(o.truth.data);
    if (!o.labels || !std::filesystem::is_directory(folder)) return std::nullopt;
    const auto knowable = [&](std::size_t i, std::size_t points) {
        return io::read_knowable(io::knowable_file(folder, io::stem(recording, i)), points);
    };
    return eval::score_knowable(recording.size(), source, knowable, o.voxel);
}

/// Whether points are scored at all distances.
bool is_any_range(const ScoredPart& part) { return part.min <= 0.0 && std::isinf(part.max); }

std::string part_text(const ScoredPart& part) {
    if (is_any_range(part) && !part.box) return "";
    std::string text = "scored are points";
    if (!is_any_range(part)) {
        const std::string far = std::isinf(part.max) ? "" : fmt::format(" to {:g} m", part.max);
        text += fmt::format(" from {:g} m{} of the sensor", part.min, far);
    }
    return text + (part.box ? " within the box\n" : "\n");
}

/// Only what was asked for: {"min_range", "max_range", "box"}.
nlohmann::ordered_json part_json(const ScoredPart& part) {
    nlohmann::ordered_json json;
    if (part.min > 0.0) json["min_range"] = part.min;
    if (std::isfinite(part.max)) json["max_range"] = part.max;
    if (part.box) json["box"] = {array_of(part.box->min()), array_of(part.box->max())};
    return json;
}

/// Opens the recording as it goes with what is to be scored.
RecordingOfResult open_truth(const EvalOptions& o) {
    RecordingOfResult truth = open_for_result(o.truth, o.labels ? *o.labels : *o.map);
    if (truth.recording.info().has_poses) return truth;
    throw InputError(o.truth.data, "",
                     "has no poses, so its voxels cannot be scored; give those of the run with "
                     "--poses");
}

/// The scans to be scored: those with ground truth where only some were to have it.
io::Recording scans_to_score(const io::Recording& recording, const EvalOptions& o) {
    if (!recording.info().has_truth()) {
        throw InputError(o.truth.data, "",
                         "has no ground truth (labels/*.label, or 0/1 intensities)");
    }
    const auto with_truth = io::scans_with_truth(recording.info());
    if (with_truth.empty()) {
        throw InputError(o.truth.data, "",
                         fmt::format("has no ground truth of the {} chosen scans, but of others",
                                     recording.size()));
    }
    const bool is_sparse = io::is_sparse_truth(with_truth.size(), recording.size());
    return is_sparse ? io::chosen_scans(recording, with_truth) : recording;
}

std::vector<std::string> names_of(const io::Recording& recording,
                                  const std::vector<std::atomic<bool>>& chosen) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i]) names.push_back(io::stem(recording, i));
    }
    return names;
}

std::string count_text(const Evaluation& e) {
    if (e.to_score == e.scans) return "";
    return fmt::format("scored {} of {} scans: those with ground truth\n",
                       e.to_score - e.left_out.size(), e.scans);
}

}  // namespace

Evaluation scores_of(const EvalOptions& o) {
    if (!(o.part.min >= 0.0 && o.part.max > o.part.min)) {
        throw ConfigError("--min-range must be 0 or more, and less than --max-range");
    }
    const RecordingOfResult truth = open_truth(o);
    const io::Recording recording = scans_to_score(truth.recording, o);
    const Eigen::Vector3d origin = scoring_origin(recording, o.voxel);
    std::vector<std::atomic<bool>> left_out(recording.size());
    const auto source_of = [&](const ScoredPart& part) {
        return o.labels ? with_labels(recording, origin, *o.labels, part)
                        : scan_source(recording, origin, {}, part);
    };
    const eval::ScanSource source = noting(source_of(o.part), left_out);
    const Points map = o.map ? positions_from(io::read_cloud(*o.map), origin) : Points{};
    eval::Scores scores = o.labels ? eval::score_labels(recording.size(), source, o.voxel)
                                   : eval::score_map(recording.size(), source, map, o.voxel);
    if (o.protocol == "erasor") {
        const eval::ScanSource points = source_of(part_of_erasor(o.part));
        scores.voxel["erasor"] =
            (o.labels ? eval::score_erasor(recording.size(), points, o.voxel)
                      : eval::score_erasor(recording.size(), points, map, o.voxel))
                .score();
    }
    std::vector<std::string> missing = names_of(recording, left_out);
    if (!scores.point.sa && !scores.point.da && missing.size() < recording.size()) {
        throw InputError(o.truth.data, "",
                         "has no point with ground truth in the part that is scored; check "
                         "--min-range, --max-range and --box, which is in the world [m]");
    }
    if (missing.size() == recording.size()) {
        throw InputError(
            o.labels ? *o.labels : o.truth.data, "",
            fmt::format("holds no label file of any readable scan in {}; labels are named "
                        "as the scans, for instance {}.label",
                        o.truth.data.string(), io::stem(recording, 0)));
    }
    return {std::move(scores),
            truth.recording.size(),
            recording.size(),
            std::move(missing),
            knowable_scores(o, recording, source),
            o.part,
            truth.note};
}

nlohmann::ordered_json to_json(const Evaluation& evaluation) {
    auto json = to_json(evaluation.scores);
    if (evaluation.knowable) json["knowable"] = to_json(*evaluation.knowable);
    const auto part = part_json(evaluation.part);
    if (!part.empty()) json["part"] = part;
    return json;
}

int evaluate(const EvalOptions& o) {
    if (o.json) require_extension(*o.json, ".json");
    const Evaluation e = scores_of(o);
    if (!e.note.empty()) say(stderr, "note: {}\n", e.note);
    say("{}{}{}", count_text(e), part_text(o.part), protocol_table(o.protocol, e.scores, o.voxel));
    if (e.knowable) say("\n{}", table(*e.knowable));
    if (o.json) io::write_file(*o.json, text_of(to_json(e)));
    if (e.left_out.empty()) return kDone;
    say(stderr, "left out {} of {} scans: unreadable, or without labels; the first is {}\n",
        e.left_out.size(), e.to_score, e.left_out.front());
    return kRejected;
}

void add_eval(Program& program) {
    Command c = program.command("eval", "Score labels or a map against ground truth");
    const auto o = std::make_shared<EvalOptions>();
    c.path("--truth", o->truth.data, "recording with ground truth").required();
    const Option labels =
        c.path("--labels", o->labels, "folder with label files, or the output folder of a run");
    c.path("--map", o->map, "clean map (.pcd or .ply) in the world frame").excludes(labels);
    add_reading_options(c, o->truth);
    add_selection_options(c, o->truth);
    c.number("--voxel", o->voxel, {0.01, 10.0}, "edge of a voxel [m]");
    c.choice("--protocol", o->protocol, protocol_names(),
             "rules by which to score: voxel is this project's, strict FreeDOM's, benchmark "
             "DynamicMap_Benchmark's, mos "
             "SemanticKITTI-MOS'");
    c.number("--min-range", o->part.min, {0.0, 1e6},
             "leave out points nearer to the sensor than this [m]");
    c.number("--max-range", o->part.max, {0.0, 1e6},
             "leave out points farther from the sensor [m]");
    const auto box = std::make_shared<std::string>();
    c.text("--box", *box,
           "two corners of a box in the world, X,Y,Z,X,Y,Z or X,Y,X,Y [m]: leave out points "
           "outside");
    c.path("-o,--json", o->json, "also write all scores to this file");
    c.action([o, box] {
        o->part.box = box_of(*box);
        if (!o->labels && !o->map)
            throw ConfigError("give what is to be scored: --labels or --map");
        return evaluate(*o);
    });
}

}  // namespace dynamic_filter::app
