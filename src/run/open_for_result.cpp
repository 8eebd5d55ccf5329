// SPDX-License-Identifier: MIT
#include "run/open_for_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "recording/recording_parts.hpp"
#include "recording/scans.hpp"
#include "run/data_json.hpp"
#include "run/placed.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// The output folder of a run, given that, its labels, or a file in it.
fs::path folder_of_result(const fs::path& given) {
    fs::path folder = fs::is_directory(given) ? given : given.parent_path();
    if (!folder.has_filename() && folder.has_parent_path()) folder = folder.parent_path();
    const bool is_labels = folder.filename() == "labels" && !fs::exists(folder / kPlacedFile);
    return is_labels ? folder.parent_path() : folder;
}

/// The options that are given, and otherwise those of the run.
DataOptions merged(const DataOptions& asked, const Placed& placed) {
    DataOptions options = placed.how;
    options.data = asked.data;
    const bool asks_more = asked.deskew == "on" && !placed.undoes_motion();
    if (asked.deskew == "off" || asks_more) options.deskew = asked.deskew;
    return options;
}

/// An option's value in a file of a run; empty if it has the default.
std::string value_text(const Json& options, const std::string& name) {
    static const Json plain = json_of(DataOptions{});
    const auto value = options.find(name);
    if (value == options.end() || (plain.contains(name) && plain[name] == *value)) return "";
    return value->is_string() ? value->get<std::string>() : value->dump();
}

/// True if the options ask for another reading than that of the run: another pose file, another
/// correction. `--poses none` asks for no poses of the recording, which those of the run are not.
bool reads_otherwise(const DataOptions& asked, const Placed& placed) {
    if (asked.poses && (*asked.poses != kNoPoses || placed.tracked.empty())) return true;
    const Json given = json_of(asked), of_run = json_of(placed.how);
    bool otherwise = false;
    visit_reading(asked, [&](const ReadingOption& option, const auto&) {
        const std::string name = option.name, value = value_text(given, name);
        if (option.selects || value.empty() || name == "deskew" || name == "poses") return;
        otherwise |= value != value_text(of_run, name);
    });
    return otherwise;
}

bool selects(const DataOptions& options) {
    return options.first > 0 || options.last || options.stride > 1;
}

/// "--pose-fix camera", "--first 10": the options of a run that still matter.
std::vector<std::string> options_text(const Placed& placed) {
    const Json options = json_of(placed.how);
    std::vector<std::string> words;
    visit_reading(placed.how, [&](const ReadingOption& option, const auto&) {
        const std::string name = option.name, value = value_text(options, name);
        const bool is_replaced = name == "poses" && !placed.tracked.empty();
        if (value.empty() || is_replaced || name == "deskew") return;
        words.push_back(as_option(option) + (value == "true" ? "" : " " + value));
    });
    return words;
}

/// What the run did that a plain reading of the recording does not do.
std::string note_of(const Placed& placed, const fs::path& folder, bool undoes_motion) {
    std::vector<std::string> words;
    if (!placed.tracked.empty()) words.emplace_back("the poses that it found or refined");
    if (undoes_motion) words.emplace_back("the motion during each scan undone");
    const std::vector<std::string> options = options_text(placed);
    words.insert(words.end(), options.begin(), options.end());
    if (words.empty()) return "";
    return fmt::format("the recording is read as by the run in {}: with {}", folder.string(),
                       fmt::join(words, ", "));
}

/// The scans of the run that are asked for. Both selections count the scans of the whole recording.
io::Recording selected(const io::Recording& recording, const DataOptions& asked,
                       const DataOptions& of_run) {
    if (!selects(asked)) return recording;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < recording.size(); ++row) {
        const std::size_t scan = of_run.first + row * of_run.stride;
        const bool is_asked = scan >= asked.first && scan <= asked.last.value_or(scan) &&
                              (scan - asked.first) % asked.stride == 0;
        if (is_asked) rows.push_back(row);
    }
    if (rows.empty()) {
        throw ConfigError(fmt::format(
            "--first, --last and --stride select none of the scans of the run, which are {} to {} "
            "in steps of {}",
            of_run.first, of_run.first + (recording.size() - 1) * of_run.stride, of_run.stride));
    }
    return io::chosen_scans(recording, rows);
}

/// Another recording than that of the run.
RecordingOfResult open_another(const DataOptions& asked, const Placed& placed,
                               const fs::path& folder, const std::string& why) {
    const std::string data = asked.data.string();
    io::Recording recording = open(asked);
    if (recording.info().has_poses) {
        return {recording, fmt::format("{} is not the recording of the run in {} ({}), so its own "
                                       "poses are used",
                                       data, folder.string(), why)};
    }
    if (placed.tracked.empty()) return {recording};
    if (recording.size() != placed.tracked.size()) {
        throw InputError(asked.data, "",
                         fmt::format("has no poses, and the run in {} left poses of {} scans, not "
                                     "of these {}; give poses with --poses",
                                     folder.string(), placed.tracked.size(), recording.size()));
    }
    return {
        io::with_poses(recording, placed.tracked),
        fmt::format("{} has no poses, so those of the run in {} are used", data, folder.string())};
}

/// The recording as it was opened for the run; empty if this is another one, and `why`.
std::optional<io::Recording> open_same(const DataOptions& options, const Placed& placed,
                                       std::string& why) {
    try {
        io::Recording recording = open(options);
        if (fingerprint_of(recording) == placed.fingerprint) return recording;
        why = "it has other scans, poses or stamps";
    } catch (const Error& error) {
        why = error.what();
    }
    return std::nullopt;
}

/// Labels without the file of a run: poses beside them are of use where there are no others.
RecordingOfResult open_with_poses_beside(DataOptions asked, const fs::path& folder) {
    io::Recording recording = open(asked);
    const fs::path poses = folder / "poses.txt";
    if (recording.info().has_poses || !fs::exists(poses)) return {recording};
    asked.poses = poses;
    return {open(asked), "the poses are those of " + poses.string()};
}

}  // namespace

RecordingOfResult open_for_result(const DataOptions& asked, const fs::path& result) {
    const fs::path folder = folder_of_result(result);
    const auto found = read_placed(folder);
    if (!found) return open_with_poses_beside(asked, folder);
    if (reads_otherwise(asked, *found)) return {open(asked)};
    std::string why;
    const DataOptions options = merged(asked, *found);
    const auto recording = open_same(options, *found, why);
    if (!recording) return open_another(asked, *found, folder, why);
    Placed placed = *found;
    if (asked.deskew == "off") placed.has_times = placed.deskewed = false;
    return {selected(placed_again(*recording, placed), asked, placed.how),
            note_of(placed, folder, placed.undoes_motion())};
}

}  // namespace dynamic_filter::app
