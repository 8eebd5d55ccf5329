// SPDX-License-Identifier: MIT
/// The scans of a bag, with poses from its topics or from a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {

struct BagScans {
    Bag bag;
    Topic topic;                       ///< topic of the scans
    std::vector<MessageRef> messages;  ///< in the order of the scans
};

/// Opens a bag; does everything except the selection of scans. Throws InputError and ConfigError.
RecordingParts open_bag(const std::filesystem::path& data, const OpenOptions& options);

/// Reads scan i with the fields of its message. Throws InputError.
Cloud read_bag_cloud(const BagScans& scans, std::size_t i);

}  // namespace dynamic_filter::io
