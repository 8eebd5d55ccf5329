// SPDX-License-Identifier: MIT
#include "map_files.hpp"

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
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
        const Eigen::Vector3d world = frame.T_world_sensor * frame.points[i].cast<double>();
        const std::byte* const from = cloud.data.data() + i * cloud.point_bytes;
        std::byte* const to = records.data() + i * layout.point_bytes;
        for (std::size_t f = 0; f < layout.fields.size(); ++f) {
            const io::Field &in = cloud.fields[f], &out = layout.fields[f];
            if (!is_coordinate(out)) {
                std::memcpy(to + out.offset, from + in.offset, out.count * io::size_of(out.type));
                continue;
            }
            const double value = world[out.name[0] - 'x'];
            out.type == io::FieldType::f64 ? store<double>(to + out.offset, value)
                                           : store<float>(to + out.offset, value);
        }
    }
    return records;
}

void MapFiles::append(const io::Frame& frame, const Verdict& verdict) {
    if (!still_) {
        layout_ = layout_of(frame, in_world_);
        still_.emplace(folder_ / "static_map.pcd", layout_.fields, layout_.point_bytes);
        dynamic_.emplace(folder_ / "dynamic_points.pcd", layout_.fields, layout_.point_bytes);
    }
    const std::size_t bytes = layout_.point_bytes;
    const auto records = in_world_ ? frame.cloud.data : world_records(frame, layout_);
    std::vector<std::byte> still, dynamic;
    still.reserve(records.size());
    for (std::size_t i = 0; i < verdict.labels.size(); ++i) {
        if (!is_measured(frame.points[i])) continue;
        const auto* const record = records.data() + i * bytes;
        const bool stays = !verdict.stays.empty() && verdict.stays[i];
        if (verdict.labels[i] == Label::dynamic && !stays) {
            dynamic.insert(dynamic.end(), record, record + bytes);
        } else if (verdict.labels[i] != Label::unknown || keep_unknown_) {
            still.insert(still.end(), record, record + bytes);
        }
    }
    still_->append(still);
    dynamic_->append(dynamic);
}

void MapFiles::commit() {
    if (!still_) return;
    still_->commit();
    dynamic_->commit();
}

}  // namespace dynamic_filter::app
