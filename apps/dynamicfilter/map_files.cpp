// SPDX-License-Identifier: MIT
#include "map_files.hpp"

#include <array>
#include <cstring>

namespace dynamic_filter::app {

namespace {

template <class T>
void store(std::byte* at, double value) {
    const auto narrowed = static_cast<T>(value);
    std::memcpy(at, &narrowed, sizeof narrowed);
}

}  // namespace

std::vector<std::byte> world_records(const io::Frame& frame) {
    std::vector<std::byte> records = frame.cloud.data;
    constexpr std::array kAxes{"x", "y", "z"};
    std::array<const io::Field*, 3> fields{};
    for (std::size_t axis = 0; axis < 3; ++axis) fields[axis] = frame.cloud.find(kAxes[axis]);
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
        const Eigen::Vector3d world = frame.T_world_sensor * frame.points[i].cast<double>();
        std::byte* const record = records.data() + i * frame.cloud.point_bytes;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double value = world[static_cast<Eigen::Index>(axis)];
            std::byte* const at = record + fields[axis]->offset;
            fields[axis]->type == io::FieldType::f64 ? store<double>(at, value)
                                                     : store<float>(at, value);
        }
    }
    return records;
}

void MapFiles::append(const io::Frame& frame, const Labels& labels) {
    if (!still_) {
        still_.emplace(folder_ / "static_map.pcd", frame.cloud.fields, frame.cloud.point_bytes);
        dynamic_.emplace(folder_ / "dynamic_points.pcd", frame.cloud.fields,
                         frame.cloud.point_bytes);
    }
    const std::size_t bytes = frame.cloud.point_bytes;
    const std::vector<std::byte> records = world_records(frame);
    std::vector<std::byte> still, dynamic;
    still.reserve(records.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (!frame.points[i].allFinite()) continue;  // labelled unknown; nothing a map can show
        const auto* const record = records.data() + i * bytes;
        if (labels[i] == Label::dynamic) {
            dynamic.insert(dynamic.end(), record, record + bytes);
        } else if (labels[i] == Label::still || keep_unknown_) {
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
