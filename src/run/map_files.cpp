// SPDX-License-Identifier: MIT
#include "run/map_files.hpp"

#include <cstring>

#include "geometry/kept.hpp"
#include "recording/world_records.hpp"

namespace dynamic_filter::app {

void MapFiles::begin(const io::FullScan& first) {
    layout_ = layout_of(first, in_world_);
    still_.emplace(folder_ / "static_map.pcd", layout_.fields, layout_.point_bytes);
    dynamic_.emplace(folder_ / "dynamic_points.pcd", layout_.fields, layout_.point_bytes);
}

MapFiles::Records MapFiles::records_of(const io::FullScan& scan, const Verdict& verdict) const {
    const std::size_t bytes = layout_.point_bytes;
    const auto all = in_world_ ? scan.cloud.data : world_records(scan, layout_);
    Records records;
    records.still.reserve(all.size());
    for (std::size_t i = 0; i < verdict.labels.size(); ++i) {
        if (!is_measured(scan.points[i])) continue;
        const auto* const record = all.data() + i * bytes;
        const bool stays = !verdict.stays.empty() && verdict.stays[i];
        const Kept kept = where(verdict.labels[i], stays, keep_unknown_);
        if (kept == Kept::nowhere) continue;
        auto& records_there = kept == Kept::removed ? records.dynamic : records.still;
        records_there.insert(records_there.end(), record, record + bytes);
    }
    return records;
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
