// SPDX-License-Identifier: MIT
#include "recording/world_records.hpp"

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

io::Cloud layout_of(const io::FullScan& scan, bool in_world) {
    constexpr double kFar = 1e4;  // [m]
    const bool far = !in_world && scan.T_world_sensor.translation().norm() > kFar;
    io::Cloud layout;
    for (const io::Field& field : scan.cloud.fields) {
        const bool widen = far && is_coordinate(field);
        io::add_field(layout, field.name, widen ? io::FieldType::f64 : field.type, field.count);
    }
    return layout;
}

std::vector<std::byte> world_records(const io::FullScan& scan, const io::Cloud& layout) {
    const io::Cloud& cloud = scan.cloud;
    std::vector<std::byte> records(scan.points.size() * layout.point_bytes);
    std::vector<Column> columns;
    for (std::size_t f = 0; f < layout.fields.size(); ++f) {
        const io::Field &in = cloud.fields[f], &out = layout.fields[f];
        columns.push_back({in.offset, out.offset, out.count * io::size_of(out.type),
                           is_coordinate(out) ? out.name[0] - 'x' : -1,
                           out.type == io::FieldType::f64});
    }
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        const Eigen::Vector3d world = scan.T_world_sensor * scan.points[i].cast<double>();
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

}  // namespace dynamic_filter::app
