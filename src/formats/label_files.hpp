// SPDX-License-Identifier: MIT
/// Where recordings and results keep labels: a file for each scan, with the scan's name.
#pragma once

#include <filesystem>
#include <string>

namespace dynamic_filter::io {

/// The folder of label files that a user means who names it, or the recording or result with it.
inline std::filesystem::path label_folder(const std::filesystem::path& given) {
    return std::filesystem::is_directory(given / "labels") ? given / "labels" : given;
}

/// `stem`: the name of the scan, without an extension.
inline std::filesystem::path label_file(const std::filesystem::path& folder,
                                        const std::string& stem) {
    return folder / (stem + ".label");
}

}  // namespace dynamic_filter::io
