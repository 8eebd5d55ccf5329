// SPDX-License-Identifier: MIT
#include "dynamic_filter/error.hpp"
#include "io/folders.hpp"
#include "io/layouts/layouts.hpp"

namespace dynamic_filter::io {

void refuse_several_recordings(const std::filesystem::path& data) {
    std::string names, first;
    for (const auto& folder : list_folders(data)) {
        if (!is_folder(folder / "velodyne")) continue;
        if (first.empty()) first = folder.string();
        names += (names.empty() ? "" : ", ") + folder.filename().string();
    }
    if (names.empty()) return;
    throw InputError(
        data, "", "holds a recording in each of " + names + "; give one of them, such as " + first);
}

}  // namespace dynamic_filter::io
