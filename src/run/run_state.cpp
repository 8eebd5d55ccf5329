// SPDX-License-Identifier: MIT
#include "run/run_state.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <sstream>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "run/placed.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kComplete = "complete\n";
constexpr std::string_view kInputLine = "input ";  // begins the line of a recording

[[noreturn]] void refuse_damaged(const fs::path& folder) {
    throw InputError(folder / kRunState, "", "is damaged; make the result again");
}

/// The number in the line that begins so; empty: there is none.
std::optional<std::size_t> number_after(std::string_view beginning, const fs::path& folder) {
    std::istringstream lines(io::read_file(folder / kRunState));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(beginning)) continue;
        std::size_t number = 0;
        const char* const end = line.data() + line.size();
        if (std::from_chars(line.data() + beginning.size(), end, number).ec != std::errc{}) {
            refuse_damaged(folder);
        }
        return number;
    }
    return std::nullopt;
}

}  // namespace

const FolderFiles& result_files() {
    static const FolderFiles files{
        .files = {"static_map.pcd", "dynamic_points.pcd", "metrics.json", "timing.json",
                  "config.toml", "run.log", "report.html", "poses.txt", kPlacedFile, "map_gaps.bin",
                  "part.json", kRunState},
        .folders = {{"labels", ".label"},
                    {"unedited", ".label"},
                    {"unedited", ".pcd"},
                    {"unedited", ".json"},
                    {"map", ".pcd"},
                    {"map", ".html"},
                    {"map", ".json"},

                    {"tiles", ".pcd"},
                    {"tiles", ".tile"},
                    {"tiles", ".evidence"},
                    {"evidence", ".evidence"},
                    {"evidence", ".json"},
                    {"evidence", ".txt"},
                    {"evidence", ""},

                    {"tiles", ""},
                    {"report", ".html"},
                    {"report", ".js"},
                    {"report", ".css"}},
        .is_of_use_in_part = true,
        .is_result = true};
    return files;
}

std::string scans_text(const io::Recording& recording) {
    std::error_code ignored;
    std::uintmax_t bytes =
        recording.info().layout == "bag" && fs::is_regular_file(recording.info().root, ignored)
            ? fs::file_size(recording.info().root, ignored)
            : 0;
    for (const fs::path& file : recording.info().scan_files) {
        if (fs::is_regular_file(file, ignored)) bytes += fs::file_size(file, ignored);
    }
    return fmt::format("scans {} from {} to {}, {} bytes", recording.size(), io::stem(recording, 0),
                       io::stem(recording, recording.size() - 1), bytes);
}

std::string state_of(const io::Recording& recording) {
    const Eigen::Vector3d at = recording.info().sensor_at.value_or(Eigen::Vector3d::Zero());
    const std::string sensor =
        at.isZero() ? "" : fmt::format("sensor at {} {} {}\n", at.x(), at.y(), at.z());
    return fmt::format("{}{}\n{}{}\n", kInputLine,
                       fs::absolute(recording.info().root).lexically_normal().string(), sensor,
                       scans_text(recording));
}

std::size_t updated_drives(const fs::path& folder) {
    const std::size_t drives = number_after(kUpdateLine, folder).value_or(0);
    if (drives > 0 && drives >= recordings_of_run(folder).size()) refuse_damaged(folder);
    return drives;
}

std::optional<std::size_t> tile_voxels_of_run(const fs::path& folder) {
    return number_after(kTilesLine, folder);
}

std::vector<fs::path> recordings_of_run(const fs::path& folder) {
    if (!fs::exists(folder / kRunState)) return {};
    std::istringstream lines(io::read_file(folder / kRunState));
    std::vector<fs::path> recordings;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kInputLine)) recordings.emplace_back(line.substr(kInputLine.size()));
    }
    return recordings;
}

void refuse_foreign_labels(const fs::path& folder) {
    const bool of_a_run = fs::exists(folder / kRunState) || fs::exists(folder / "config.toml");
    if (of_a_run || !fs::exists(folder / "labels")) return;
    throw ConfigError(
        folder.string() +
        ": holds labels that no run left, so --overwrite is refused; choose another -o");
}

void write_state(const OutputFolder& output, std::string_view state) {
    io::write_file(output.path() / kRunState, state);
}

void write_complete(const OutputFolder& output, std::string_view state) {
    write_state(output, std::string(state) + std::string(kComplete));
}

bool is_whole_run(const fs::path& folder) {
    return fs::exists(folder / kRunState) && io::read_file(folder / kRunState).ends_with(kComplete);
}

bool is_begun(const fs::path& folder, std::string_view state) {
    const fs::path file = folder / kRunState;
    return fs::exists(file) && io::read_file(file) == state;
}

bool is_complete(const fs::path& folder, std::string_view state) {
    return is_begun(folder, std::string(state) + std::string(kComplete));
}

void refuse_other_run(const OutputFolder& output, std::string_view state) {
    const fs::path& folder = output.path();
    if (output.is_empty() || is_begun(folder, state) || is_complete(folder, state)) return;
    if (!fs::exists(folder / kRunState)) {
        throw ConfigError(output.name().string() +
                          ": holds something that no run of this version began; use --overwrite "
                          "or another -o");
    }
    throw ConfigError(output.name().string() +
                      ": was begun with another recording, other poses or another way to read it, "
                      "other settings or --refine, "
                      "other tiles (--memory, --tile-voxels), other outputs (--no-maps, "
                      "--no-report) or another version; go on "
                      "with those (see config.toml and run.log there), or start afresh with "
                      "--overwrite");
}

}  // namespace dynamic_filter::app
