// SPDX-License-Identifier: MIT
#include "arena/find.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "recording/folders.hpp"

namespace dynamic_filter::app {

namespace fs = std::filesystem;

std::optional<fs::path> first_folder(const std::vector<fs::path>& choices) {
    const auto found = std::find_if(choices.begin(), choices.end(), io::is_folder);
    return found == choices.end() ? std::nullopt : std::optional(*found);
}

std::optional<ScanWindow> semantickitti_window(const std::string& sequence) {
    static const std::map<std::string, ScanWindow> windows = {{"00", {4390, 4530, 2}},
                                                              {"01", {150, 250, 1}},
                                                              {"02", {860, 950, 2}},
                                                              {"05", {2350, 2670, 2}},
                                                              {"07", {630, 820, 2}}};
    const auto found = windows.find(sequence);
    return found == windows.end() ? std::nullopt : std::optional(found->second);
}

void choose_window(DataOptions& data, const fs::path& folder, const std::string& extension,
                   const ScanWindow& window) {
    std::size_t wanted = window.first, index = 0;
    std::optional<std::size_t> begin;
    for (const fs::path& file : io::list_files(folder, {extension})) {
        const auto number = io::parse_real(file.stem().string());
        if (number && *number >= static_cast<double>(window.first) && !begin) begin = index;
        if (begin && number == static_cast<double>(wanted) && wanted <= window.last) {
            if ((index - *begin) != wanted - window.first) break;  // one between them is missing
            wanted += window.step;
        }
        ++index;
    }
    if (wanted <= window.last) {
        throw InputError(
            folder, "",
            fmt::format(
                "scan {:06}{} is missing, or one before it; the arena needs all from {} to {}",
                wanted, extension, window.first, window.last));
    }
    data.first = *begin;
    data.last = *begin + (window.last - window.first);
    data.stride = window.step;
}

std::optional<Trial> find_sequence(const fs::path& root, const std::string& sequence,
                                   const std::vector<std::string>& pose_files) {
    const auto folder = first_folder({root / "sequences" / sequence,
                                      root / "dataset" / "sequences" / sequence, root / sequence});
    if (!folder || !io::is_folder(*folder / "velodyne")) return std::nullopt;
    if (!io::is_folder(*folder / "labels")) {
        throw InputError(*folder, "",
                         "has scans, but no folder labels: unpack the label data of SemanticKITTI "
                         "(semantic-kitti.org) into the same folder");
    }
    if (!io::present(*folder / "calib.txt")) {
        throw InputError(
            *folder, "",
            "has no calib.txt, without which the poses of the camera cannot be turned: "
            "unpack the calibration files of KITTI's odometry benchmark (cvlibs.net) "
            "into the same folder");
    }
    Trial trial{.entry = sequence, .data = {.data = *folder, .format = "kitti"}};
    for (const std::string& name : pose_files) {
        if (trial.data.poses || !io::present(*folder / name)) continue;
        trial.data.poses = *folder / name;
        trial.notes.push_back(fmt::format("poses of {}", name));
    }
    if (trial.data.poses) return trial;
    throw InputError(*folder, "", fmt::format("has no {}", fmt::join(pose_files, " and no ")));
}

void require_whole(const Trial& trial, const io::Recording& recording) {
    const std::size_t rows = io::read_poses(*trial.data.poses).poses.size();
    if (rows == recording.size()) return;
    throw InputError(trial.data.data, "",
                     fmt::format("has {} scans, but {} has {} poses; the arena needs all scans, so "
                                 "download the parts that are missing",
                                 recording.size(), trial.data.poses->filename().string(), rows));
}

}  // namespace dynamic_filter::app
