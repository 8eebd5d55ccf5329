// SPDX-License-Identifier: MIT
/// The result of one reading of a bag: the clouds and the poses of each topic, and the tree of
/// frames.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/poses.hpp"
#include "recording/frame_tree.hpp"
#include "recording/pose_source.hpp"

namespace dynamic_filter::io {

struct FoundScan {
    double stamp = 0.0;
    std::int64_t recorded_ns = 0;
    MessageRef ref;
    std::string frame;
    std::size_t bytes = 0;  // size of the message
    std::uint32_t end = 0;  // checksum of its last bytes
};
struct CloudTopic {
    Topic topic;
    std::vector<FoundScan> scans;
};

/// The contents of a bag, and what could not be read.
struct BagContents {
    std::map<std::string, CloudTopic> clouds;
    std::map<std::string, PoseTopic> poses;
    // Types of topics with raw packets, from which a driver makes clouds.
    std::map<std::string, std::string> packets;
    // Types of topics with clouds that are not read.
    std::map<std::string, std::string> other_clouds;
    FrameTree frames;
    std::vector<std::string> notes, losses;
};

/// Reads the whole bag once. Throws InputError.
BagContents contents_of(const Bag& bag);

}  // namespace dynamic_filter::io
