// SPDX-License-Identifier: MIT
/// What could be known of the points of simulated scans: a file for each scan, with the scan's
/// name.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/file.hpp"
#include "geometry/knowable.hpp"

namespace dynamic_filter::io {

/// The folder of these files, in the folder of a recording.
inline std::filesystem::path knowable_folder(const std::filesystem::path& recording) {
    return recording / "knowable";
}

/// `stem`: the name of the scan, without an extension.
inline std::filesystem::path knowable_file(const std::filesystem::path& folder,
                                           const std::string& stem) {
    return folder / (stem + ".bin");
}

/// Writes four bytes a point: uint16 of beams, the state, and 1 if the thing is seen to move.
void write_knowable(const std::filesystem::path& file, std::span<const KnowablePoint> points,
                    Durable durable = Durable::name);

/// Throws InputError if the file is missing, or is none of a scan with so many points.
std::vector<KnowablePoint> read_knowable(const std::filesystem::path& file, std::size_t points);

}  // namespace dynamic_filter::io
