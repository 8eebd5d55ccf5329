// SPDX-License-Identifier: MIT
#include "recording/world_records.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <string>

#include "dynamic_filter/error.hpp"

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

/// Bytes of a record that are copied as they are.
struct Copied {
    std::size_t from, to, bytes;
};
/// Fields that lie beside each other in both records are copied at once.
std::vector<Copied> copied_bytes(const io::Cloud& cloud, const io::Cloud& layout) {
    std::vector<Copied> all;
    for (std::size_t f = 0; f < layout.fields.size(); ++f) {
        const io::Field &in = cloud.fields[f], &out = layout.fields[f];
        if (in.type != out.type) continue;  // a coordinate
        const Copied next{in.offset, out.offset, out.count * io::size_of(out.type)};
        const bool goes_on = !all.empty() && all.back().from + all.back().bytes == next.from &&
                             all.back().to + all.back().bytes == next.to;
        if (goes_on) {
            all.back().bytes += next.bytes;
        } else {
            all.push_back(next);
        }
    }
    return all;
}

/// Where a coordinate goes.
struct Coordinate {
    std::size_t to;
    int axis;
    bool is_double;
};
std::vector<Coordinate> coordinates_of(const io::Cloud& layout) {
    std::vector<Coordinate> all;
    for (const io::Field& field : layout.fields) {
        if (!is_coordinate(field)) continue;
        all.push_back({field.offset, field.name[0] - 'x', field.type == io::FieldType::f64});
    }
    return all;
}

std::string names_of(const std::vector<io::Field>& fields) {
    std::string names;
    for (const io::Field& field : fields) names += (names.empty() ? "" : " ") + field.name;
    return names;
}

}  // namespace

void refuse_other_fields(const io::FullScan& scan, const io::Cloud& layout) {
    const auto is_same = [](const io::Field& a, const io::Field& b) {
        return a.name == b.name && a.count == b.count && (a.type == b.type || is_coordinate(a));
    };
    if (std::equal(scan.cloud.fields.begin(), scan.cloud.fields.end(), layout.fields.begin(),
                   layout.fields.end(), is_same)) {
        return;
    }
    throw ConfigError("scans have the fields " + names_of(layout.fields) + ", and others " +
                      names_of(scan.cloud.fields) +
                      ", or other types of them; one cloud can hold those of one kind");
}

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
    std::vector<std::uint32_t> all(scan.points.size());
    std::iota(all.begin(), all.end(), 0U);
    return world_records(scan, layout, all);
}

std::vector<std::byte> world_records(const io::FullScan& scan, const io::Cloud& layout,
                                     std::span<const std::uint32_t> points) {
    const std::vector<Copied> copied = copied_bytes(scan.cloud, layout);
    const std::vector<Coordinate> coordinates = coordinates_of(layout);
    std::vector<std::byte> records(points.size() * layout.point_bytes);
    std::byte* to = records.data();
    for (const std::uint32_t i : points) {
        const std::byte* const from = scan.cloud.data.data() + i * scan.cloud.point_bytes;
        for (const Copied& c : copied) std::memcpy(to + c.to, from + c.from, c.bytes);
        const Eigen::Vector3d world = scan.T_world_sensor * scan.points[i].cast<double>();
        for (const Coordinate& c : coordinates) {
            c.is_double ? store<double>(to + c.to, world[c.axis])
                        : store<float>(to + c.to, world[c.axis]);
        }
        to += layout.point_bytes;
    }
    return records;
}

void append_record(std::vector<std::byte>& to, std::span<const std::byte> records, std::size_t i,
                   std::size_t bytes) {
    const auto record = records.subspan(i * bytes, bytes);
    to.insert(to.end(), record.begin(), record.end());
}

}  // namespace dynamic_filter::app
