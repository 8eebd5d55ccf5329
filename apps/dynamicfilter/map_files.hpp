// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "dynamic_filter/io/sequence.hpp"
#include "dynamic_filter/io/writers.hpp"

namespace dynamic_filter::app {

/// static_map.pcd and dynamic_points.pcd: the original records, x y z in the world frame.
/// The fields are those of the first frame. Single caller.
class MapFiles {
public:
    MapFiles(std::filesystem::path folder, bool keep_unknown)
        : folder_(std::move(folder)), keep_unknown_(keep_unknown) {}

    void append(const io::Frame& frame, const Labels& labels);
    void commit();

private:
    std::filesystem::path folder_;
    bool keep_unknown_;
    std::optional<io::PcdWriter> still_, dynamic_;
};

/// The frame's records with x y z in the world frame.
std::vector<std::byte> world_records(const io::Frame& frame);

}  // namespace dynamic_filter::app
