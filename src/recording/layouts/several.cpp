// SPDX-License-Identifier: MIT
#include "dynamic_filter/error.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/layouts.hpp"

namespace dynamic_filter::io {

void refuse_several(const std::filesystem::path& data, const Paths& recordings) {
    std::string names;
    for (const auto& recording : recordings) {
        names += (names.empty() ? "" : ", ") + recording.lexically_relative(data).string();
    }
    throw InputError(data, "",
                     "holds a recording in each of " + names + "; give one of them, such as " +
                         recordings.front().string());
}

void refuse_several_recordings(const std::filesystem::path& data) {
    Paths recordings;
    for (const auto& folder : list_folders(data)) {
        if (is_folder(folder / "velodyne")) recordings.push_back(folder);
    }
    if (recordings.size() > 1) refuse_several(data, recordings);
}

}  // namespace dynamic_filter::io
