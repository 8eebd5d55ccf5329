// SPDX-License-Identifier: MIT
#include "recording/drives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/layouts.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

bool is_list(const fs::path& path) {
    return path.extension() == ".txt" && fs::is_regular_file(path);
}

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \r");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \r") - first + 1);
}

std::vector<DriveSource> read_list(const fs::path& list) {
    std::istringstream lines(io::read_file(list));
    std::vector<DriveSource> sources;
    const auto path_of = [&](const std::string& text) {
        return (list.parent_path() / text).lexically_normal();
    };
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        if (++number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
        const auto tab = line.find('\t');
        const std::string recording = trimmed(line.substr(0, tab));
        const std::string poses = tab == std::string::npos ? "" : trimmed(line.substr(tab + 1));
        if (recording.empty() || recording.front() == '#') continue;
        DriveSource source{.recording = path_of(recording)};
        if (!is_there(source.recording)) {
            throw InputError(list, fmt::format("line {}", number),
                             source.recording.string() + " does not exist");
        }
        if (!poses.empty()) source.poses = path_of(poses);
        sources.push_back(std::move(source));
    }
    if (sources.empty()) {
        throw InputError(list, "", "lists no recording; expected the path of one on each line");
    }
    return sources;
}

/// The last `parts` parts of a path, with _ between them.
std::string ending_of(const fs::path& path, int parts) {
    fs::path rest = io::whole_path(path);
    std::string name = rest.stem().string();
    for (int i = 1; i < parts && rest.parent_path().has_filename(); ++i) {
        rest = rest.parent_path();
        name = rest.filename().string() + "_" + name;
    }
    return name;
}

void refuse_twice(const std::vector<DriveSource>& sources) {
    std::set<fs::path> seen;
    for (const DriveSource& source : sources) {
        if (seen.insert(fs::weakly_canonical(source.recording)).second) continue;
        throw ConfigError(source.recording.string() + ": is given twice; name each recording once");
    }
}

}  // namespace

bool is_there(const fs::path& recording) {
    return fs::exists(recording) || io::names_scene(recording);
}

std::vector<DriveSource> expand(const std::vector<fs::path>& recordings) {
    std::vector<DriveSource> sources;
    for (const fs::path& path : recordings) {
        if (!is_list(path)) {
            sources.push_back({.recording = path});
            continue;
        }
        const std::vector<DriveSource> listed = read_list(path);
        sources.insert(sources.end(), listed.begin(), listed.end());
    }
    return sources;
}

std::vector<std::string> names_of(const std::vector<DriveSource>& sources) {
    std::vector<std::string> names;
    for (const int parts : {1, 2}) {
        names.clear();
        for (const DriveSource& source : sources) {
            names.push_back(ending_of(source.recording, parts));
        }
        if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) return names;
    }
    std::set<std::string> taken;
    for (std::string& name : names) {
        const std::string base = name;
        for (int number = 2; !taken.insert(name).second; ++number) {
            name = fmt::format("{}_{}", base, number);
        }
    }
    return names;
}

std::vector<DataOptions> options_of(const std::vector<DriveSource>& sources,
                                    const DataOptions& how) {
    refuse_twice(sources);
    const auto& poses = how.poses;
    if (sources.size() > 1 && poses && *poses != "none") {
        throw ConfigError(
            "--poses " + poses->string() +
            ": belongs to one recording, but several are given; leave the pose file of each one in "
            "its folder, or give a list (.txt) with a line for each: the recording, a tab, its "
            "pose file");
    }
    std::vector<DataOptions> each;
    for (const DriveSource& source : sources) {
        each.push_back(how);
        each.back().data = source.recording;
        if (source.poses && !poses) each.back().poses = source.poses;
    }
    return each;
}

std::vector<DriveSource> with_pose_files(const std::vector<DriveSource>& sources,
                                         const DataOptions& how) {
    std::vector<DriveSource> each;
    for (const DataOptions& one : options_of(sources, how)) {
        each.push_back({.recording = one.data, .poses = one.poses});
    }
    return each;
}

std::vector<Drive> open_drives(const std::vector<DriveSource>& sources, const DataOptions& how) {
    for (const DriveSource& source : sources) {
        if (is_there(source.recording)) continue;
        throw ConfigError(source.recording.string() +
                          ": does not exist; several recordings may be given, and -o names the "
                          "output folder");
    }
    const std::vector<DataOptions> options = options_of(sources, how);
    const std::vector<std::string> names = names_of(sources);
    std::vector<Drive> drives;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        Drive drive{.name = names[i], .recording = open(options[i])};
        if (!drive.recording.info().has_poses) {
            throw InputError(options[i].data, "",
                             "has no poses, so it has no place in a common world; give its poses "
                             "(`dynamicfilter odometry` finds them: --onto RESULT in the world of "
                             "an earlier run)");
        }
        drives.push_back(std::move(drive));
    }
    return drives;
}

}  // namespace dynamic_filter::app
