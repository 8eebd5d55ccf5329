// SPDX-License-Identifier: MIT
#include "run/map_files.hpp"

#include <cstring>

#include "geometry/kept.hpp"
#include "recording/world_records.hpp"

namespace dynamic_filter::app {

namespace {

std::vector<std::byte> records_as_they_are(const io::Cloud& cloud,
                                           const std::vector<std::uint32_t>& points) {
    std::vector<std::byte> records(points.size() * cloud.point_bytes);
    std::byte* to = records.data();
    for (const std::uint32_t i : points) {
        std::memcpy(to, cloud.data.data() + i * cloud.point_bytes, cloud.point_bytes);
        to += cloud.point_bytes;
    }
    return records;
}

}  // namespace

void MapFiles::begin(const io::FullScan& first) {
    layout_ = layout_of(first, in_world_);
    still_.emplace(folder_ / "static_map.pcd", layout_.fields, layout_.point_bytes);
    dynamic_.emplace(folder_ / "dynamic_points.pcd", layout_.fields, layout_.point_bytes);
}

MapFiles::Records MapFiles::records_of(const io::FullScan& scan, const Verdict& verdict) const {
    std::vector<std::uint32_t> still, dynamic;
    still.reserve(verdict.labels.size());
    for (std::uint32_t i = 0; i < verdict.labels.size(); ++i) {
        if (!is_measured(scan.points[i])) continue;
        const bool stays = !verdict.stays.empty() && verdict.stays[i];
        const Kept kept = where(verdict.labels[i], stays, keep_unknown_);
        if (kept == Kept::nowhere) continue;
        (kept == Kept::removed ? dynamic : still).push_back(i);
    }
    const auto records_at = [&](const std::vector<std::uint32_t>& points) {
        return in_world_ ? records_as_they_are(scan.cloud, points)
                         : world_records(scan, layout_, points);
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
