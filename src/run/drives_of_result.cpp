// SPDX-License-Identifier: MIT
#include "run/drives_of_result.hpp"

#include <fmt/format.h>

#include "base/output_folder.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/label_files.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "recording/drives.hpp"
#include "recording/folders.hpp"
#include "recording/scans.hpp"
#include "run/run_state.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

fs::path output_of(const fs::path& result) {
    return is_tiled_map(result) ? io::whole_path(map_folder_of(result)).parent_path()
                                : io::whole_path(result);
}

bool is_of_update(const fs::path& result) {
    const fs::path folder = output_of(result);
    return fs::exists(folder / kRunState) && updated_drives(folder) > 0;
}

std::vector<DriveOfResult> drives_of_result(const fs::path& result) {
    const bool is_tiled = is_tiled_map(result);
    const fs::path folder = output_of(result);
    const std::vector<fs::path> recordings = recordings_of_run(folder);
    std::vector<DriveOfResult> drives;
    if (!is_tiled && recordings.size() == 1) {
        drives.push_back({folder.filename().string(), recordings.front(), folder});
    } else if (is_tiled) {
        for (const MapDrive& drive : read_map_index(folder / kMapFolder).drives) {
            const std::size_t i = drives.size();
            if (i >= recordings.size()) break;
            const bool is_only = recordings.size() == 1;
            drives.push_back(
                {drive.name, recordings[i], is_only ? folder : folder / "drives" / drive.name});
        }
    }
    if (drives.empty() || drives.size() != recordings.size()) {
        throw InputError(result, "",
                         "is not the whole output folder of a run: the file .run in it tells where "
                         "the recordings are");
    }
    if (!is_whole_run(folder)) {
        throw InputError(folder, "", "the run is not complete; run --resume goes on with it");
    }
    drives.erase(drives.begin(),
                 drives.begin() + static_cast<std::ptrdiff_t>(updated_drives(folder)));
    for (const DriveOfResult& drive : drives) {
        if (is_there(drive.recording)) continue;
        throw InputError(drive.recording, "",
                         "is not there any more; the run in " + folder.string() + " read it");
    }
    return drives;
}

std::optional<fs::path> settings_file_of(const fs::path& folder) {
    for (const fs::path& result : {folder, folder / ".." / ".."}) {
        const fs::path file = (result / "config.toml").lexically_normal();
        if (fs::exists(result / kRunState) && fs::exists(file)) return file;
    }
    return std::nullopt;
}

bool has_labels(const fs::path& folder, const io::Recording& recording, std::size_t i) {
    return fs::exists(io::label_file(io::label_folder(folder), io::stem(recording, i)));
}

Labels labels_of_scan(const fs::path& folder, const io::Recording& recording, std::size_t i,
                      std::size_t points) {
    const std::string stem = io::stem(recording, i);
    const fs::path labels_folder = io::label_folder(folder);
    Labels labels = io::read_labels(io::label_file(labels_folder, stem));
    if (labels.size() == points) return labels;
    throw ConfigError(
        fmt::format("{}: {} labels for the {} points of scan {}; are they of another recording?",
                    labels_folder.string(), labels.size(), points, stem));
}

}  // namespace dynamic_filter::app
