// SPDX-License-Identifier: MIT
/// Chooses the clouds of a bag that are the scans.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "recording/bag_contents.hpp"

namespace dynamic_filter::io {

/// Clouds of one frame on one topic, in order.
struct BagClouds {
    Topic topic;
    std::string frame{};
    std::vector<FoundScan> scans;
    std::vector<std::uint8_t> repeats{};  ///< as in Info
    std::vector<std::string> notes{}, losses{};
};

/// `wanted`: a topic, or TOPIC@FRAME; empty: the only topic, and the frame with most clouds. Throws
/// InputError if there are no clouds, and ConfigError if there is a choice, or not the wanted ones.
BagClouds choose_clouds(const Bag& bag, const BagContents& contents,
                        const std::filesystem::path& data, const std::string& wanted);

}  // namespace dynamic_filter::io
