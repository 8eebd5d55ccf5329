// SPDX-License-Identifier: MIT
#include "run/map_files.hpp"

#include <cstring>

namespace dynamic_filter::app {

namespace {

template <class T>
void store(std::byte* at, double value) {
    const auto narrowed = static_cast<T>(value);
    std::memcpy(at, &narrowed, sizeof narrowed);
}

bool is_coordinate(const io::Field& field) {
    return field.name == "x" || field.name == "y" || field.name == "z";
}

/// Where a field of a record comes from and goes to.
struct Column {
    std::size_t from, to, bytes;
    int axis;  // 0..2: a coordinate; -1: none
    bool is_double;
};

}  // namespace

io::Cloud layout_of(const io::Frame& frame, bool in_world) {
    constexpr double kFar = 1e4;  // [m]
    const bool far = !in_world && frame.T_world_sensor.translation().norm() > kFar;
    io::Cloud layout;
    for (const io::Field& field : frame.cloud.fields) {
        const bool widen = far && is_coordinate(field);
        io::add_field(layout, field.name, widen ? io::FieldType::f64 : field.type, field.count);
    }
    return layout;
}

std::vector<std::byte> world_records(const io::Frame& frame, const io::Cloud& layout) {
    const io::Cloud& cloud = frame.cloud;
    std::vector<std::byte> records(frame.points.size() * layout.point_bytes);
    std::vector<Column> columns;
    for (std::size_t f = 0; f < layout.fields.size(); ++f) {
        const io::Field &in = cloud.fields[f], &out = layout.fields[f];
        columns.push_back({in.offset, out.offset, out.count * io::size_of(out.type),
                           is_coordinate(out) ? out.name[0] - 'x' : -1,
                           out.type == io::FieldType::f64});
    }
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
        const Eigen::Vector3d world = frame.T_world_sensor * frame.points[i].cast<double>();
        const std::byte* const from = cloud.data.data() + i * cloud.point_bytes;
        std::byte* const to = records.data() + i * layout.point_bytes;
        for (const Column& column : columns) {
            if (column.axis < 0) {
                std::memcpy(to + column.to, from + column.from, column.bytes);
                continue;
            }
            const double value = world[column.axis];
            column.is_double ? store<double>(to + column.to, value)
                             : store<float>(to + column.to, value);
        }
    }
    return records;
}

void MapFiles::begin(const io::Frame& first) {
    layout_ = layout_of(first, in_world_);
    still_.emplace(folder_ / "static_map.pcd", layout_.fields, layout_.point_bytes);
    dynamic_.emplace(folder_ / "dynamic_points.pcd", layout_.fields, layout_.point_bytes);
}

MapFiles::Records MapFiles::records_of(const io::Frame& frame, const Verdict& verdict) const {
    const std::size_t bytes = layout_.point_bytes;
    const auto all = in_world_ ? frame.cloud.data : world_records(frame, layout_);
    Records records;
    records.still.reserve(all.size());
    for (std::size_t i = 0; i < verdict.labels.size(); ++i) {
        if (!is_measured(frame.points[i])) continue;
        const auto* const record = all.data() + i * bytes;
        const bool stays = !verdict.stays.empty() && verdict.stays[i];
        if (verdict.labels[i] == Label::dynamic && !stays) {
            records.dynamic.insert(records.dynamic.end(), record, record + bytes);
        } else if (verdict.labels[i] != Label::unknown || keep_unknown_) {
            records.still.insert(records.still.end(), record, record + bytes);
        }
    }
    return records;
}

void MapFiles::append(const Records& records) {
    still_->append(records.still);
    dynamic_->append(records.dynamic);
}

void MapFiles::append(const io::Frame& frame, const Verdict& verdict) {
    if (!still_) begin(frame);
    append(records_of(frame, verdict));
}

void MapFiles::commit() {
    if (!still_) return;
    still_->commit();
    dynamic_->commit();
}

}  // namespace dynamic_filter::app
