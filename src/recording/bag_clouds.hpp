// SPDX-License-Identifier: MIT
/// Chooses the clouds of a bag that are the scans.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "recording/bag_contents.hpp"

namespace dynamic_filter::io {

/// Clouds of a topic, in order.
struct BagClouds {
    Topic topic;
    std::vector<FoundScan> scans;
    std::vector<std::string> frames{};    ///< of the clouds; that of most clouds is first
    std::vector<std::uint8_t> repeats{};  ///< as in Info
    std::vector<std::string> notes{}, losses{};
};

/// `wanted`: a topic, or TOPIC@FRAME; empty: the only topic. Throws InputError if there are no
/// clouds, and ConfigError if there is a choice, or not the wanted ones.
BagClouds choose_clouds(const Bag& bag, const BagContents& contents,
                        const std::filesystem::path& data, const std::string& wanted);

/// Keeps the clouds of the first frame only, if there are several; then a loss says so.
void keep_first_frame(BagClouds& clouds);

}  // namespace dynamic_filter::io
