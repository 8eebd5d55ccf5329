// SPDX-License-Identifier: MIT
#include "run/map_files.hpp"

#include "base/little_endian.hpp"
#include "dynamic_filter/error.hpp"
#include "geometry/kept.hpp"
#include "recording/world_records.hpp"

namespace dynamic_filter::app {

namespace {

constexpr const char* kProbability = "probability";

std::vector<std::byte> records_as_they_are(const io::Cloud& cloud,
                                           const std::vector<std::uint32_t>& points) {
    std::vector<std::byte> records;
    records.reserve(points.size() * cloud.point_bytes);
    for (const std::uint32_t i : points) append_record(records, cloud.data, i, cloud.point_bytes);
    return records;
}

/// The records of these points, each followed by its probability.
std::vector<std::byte> with_probability(const std::vector<std::byte>& records, std::size_t bytes,
                                        const std::vector<std::uint32_t>& points,
                                        const std::vector<float>& probability) {
    std::vector<std::byte> all;
    all.reserve(records.size() + points.size() * sizeof(float));
    for (std::size_t k = 0; k < points.size(); ++k) {
        append_record(all, records, k, bytes);
        put(all, probability[points[k]]);
    }
    return all;
}

}  // namespace

void MapFiles::begin(const io::FullScan& first) {
    layout_ = layout_of(first, in_world_);
    io::Cloud written = layout_;
    if (config_.probability) {
        if (written.find(kProbability) != nullptr) {
            throw ConfigError("map.probability: the scans have a field probability already");
        }
        io::add_field(written, kProbability, io::FieldType::f32);
    }
    still_.emplace(folder_ / "static_map.pcd", written.fields, written.point_bytes);
    dynamic_.emplace(folder_ / "dynamic_points.pcd", written.fields, written.point_bytes);
}

MapFiles::Records MapFiles::records_of(const io::FullScan& scan, const Verdict& verdict) const {
    std::vector<std::uint32_t> still, dynamic;
    still.reserve(verdict.labels.size());
    for (std::uint32_t i = 0; i < verdict.labels.size(); ++i) {
        if (!is_measured(scan.points[i])) continue;
        const bool stays = !verdict.stays.empty() && verdict.stays[i];
        const Kept kept = where(verdict.labels[i], stays, config_.keep_unknown);
        if (kept == Kept::nowhere) continue;
        (kept == Kept::removed ? dynamic : still).push_back(i);
    }
    const auto records_at = [&](const std::vector<std::uint32_t>& points) {
        std::vector<std::byte> records = in_world_ ? records_as_they_are(scan.cloud, points)
                                                   : world_records(scan, layout_, points);
        if (!config_.probability) return records;
        return with_probability(records, layout_.point_bytes, points, verdict.probability);
    };
    return {records_at(still), records_at(dynamic)};
}

void MapFiles::append(const Records& records) {
    still_->append(records.still);
    dynamic_->append(records.dynamic);
}

void MapFiles::append(const io::FullScan& scan, const Verdict& verdict) {
    if (!still_) begin(scan);
    append(records_of(scan, verdict));
}

void MapFiles::commit() {
    if (!still_) return;
    still_->commit();
    dynamic_->commit();
}

}  // namespace dynamic_filter::app
