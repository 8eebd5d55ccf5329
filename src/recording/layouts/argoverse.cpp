// SPDX-License-Identifier: MIT
#include "dynamic_filter/error.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/layouts.hpp"

namespace dynamic_filter::io {
namespace {

/// Folders that may hold the scans: those of this log, and those of logs up to two levels below
/// (av2/val/LOG).
Paths scan_folders(const std::filesystem::path& data) {
    Paths folders{data / "sensors" / "lidar", data / "lidar", data};
    for (const auto& part : list_folders(data)) {
        folders.push_back(part / "sensors" / "lidar");
        for (const auto& log : list_folders(part)) folders.push_back(log / "sensors" / "lidar");
    }
    return folders;
}

}  // namespace

void refuse_argoverse(const std::filesystem::path& data) {
    for (const auto& folder : scan_folders(data)) {
        std::error_code ignored;
        if (list_files(folder, {".feather"}, ignored).empty()) continue;
        throw InputError(
            folder, "",
            "holds Apache Arrow's *.feather files, as logs of Argoverse 2 do, which are not read: "
            "with Python's pyarrow, write a .bin or .npy file for each sweep and a pose file from "
            "city_SE3_egovehicle.feather; docs/formats.md has the lines to type");
    }
}

}  // namespace dynamic_filter::io
