// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/writers.hpp"

namespace dynamic_filter::app {

/// static_map.pcd and dynamic_points.pcd: the original records, x y z in the world frame. The
/// fields are those of the first scan; far from the world's origin, where a float is coarse, x y z
/// become float64. With `map.probability`, a field probability is added. What is no measurement
/// (not finite, at the sensor) is no point of a map. Single caller; records_of() may run in several
/// threads after begin().
class MapFiles {
public:
    /// What one scan adds to the two files.
    struct Records {
        std::vector<std::byte> still, dynamic;
    };
    /// `in_world`: the records hold world coordinates already and are passed on as they are.
    MapFiles(std::filesystem::path folder, const MapConfig& config, bool in_world)
        : folder_(std::move(folder)), config_(config), in_world_(in_world) {}

    /// Reads the fields of the first scan, and opens the files. Throws ConfigError if the scan has
    /// a field probability already, and another one is to be added.
    void begin(const io::FullScan& first);
    /// Splits the points of a scan. Points with Verdict::stays belong to the static map.
    [[nodiscard]] Records records_of(const io::FullScan& scan, const Verdict& verdict) const;
    void append(const Records& records);
    /// Begins if need be, and appends the records of this scan.
    void append(const io::FullScan& scan, const Verdict& verdict);
    void commit();

private:
    std::filesystem::path folder_;
    MapConfig config_;
    bool in_world_;
    io::Cloud layout_;  ///< fields of the maps but the probability, no records
    std::optional<io::PcdWriter> still_, dynamic_;
};

}  // namespace dynamic_filter::app
