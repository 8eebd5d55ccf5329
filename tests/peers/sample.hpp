// SPDX-License-Identifier: MIT
/// What the programs here have in common: random points, and how values are printed.
#pragma once

#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/cloud.hpp"
#include "support/random.hpp"

namespace dynamic_filter::io {

inline std::uint32_t fnv1a(const std::vector<double>& values) {
    std::uint32_t hash = 0x811c9dc5U;
    for (const std::byte byte : std::as_bytes(std::span(values))) {
        hash = (hash ^ std::to_integer<std::uint32_t>(byte)) * 0x01000193U;
    }
    return hash;
}

/// x, y, z of `type` and intensity, among fields that others must step over.
inline Cloud sample_fields(FieldType type) {
    Cloud cloud;
    add_field(cloud, "time", FieldType::u64);
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, type);
    add_field(cloud, "ring", FieldType::u16, 3);
    add_field(cloud, "intensity", FieldType::f32);
    return cloud;
}

/// Random numbers where a field is a float, 0 or 1 where it is a byte, 0 elsewhere.
inline void fill(Cloud& cloud, std::size_t points, test::Random& random) {
    cloud.data.resize(points * cloud.point_bytes);
    for (std::size_t i = 0; i < points; ++i) {
        for (const Field& field : cloud.fields) {
            std::byte* to = cloud.data.data() + i * cloud.point_bytes + field.offset;
            const double wide = random.uniform(-100.0, 100.0);
            const auto narrow = static_cast<float>(wide);
            const auto sign = static_cast<std::uint8_t>(wide < 0.0);
            if (field.type == FieldType::f64) std::memcpy(to, &wide, sizeof wide);
            if (field.type == FieldType::f32) std::memcpy(to, &narrow, sizeof narrow);
            if (field.type == FieldType::u8) std::memcpy(to, &sign, sizeof sign);
        }
    }
}

inline Cloud random_cloud(std::size_t points, FieldType type, test::Random& random) {
    Cloud cloud = sample_fields(type);
    fill(cloud, points, random);
    return cloud;
}

inline OccupancyCells random_cells(std::size_t width, test::Random& random) {
    OccupancyCells cells{0.25, static_cast<std::uint32_t>(width), 7, {}, {}};
    for (double& value : cells.origin) value = random.uniform(-100.0, 100.0);
    constexpr std::array<std::int8_t, 3> kValues{-1, 0, 100};
    for (std::size_t i = 0; i < 7 * width; ++i) cells.values.push_back(kValues[random.below(3)]);
    return cells;
}

inline std::vector<double> cell_values(const OccupancyCells& cells) {
    std::vector<double> all{cells.cell, static_cast<double>(cells.width),
                            static_cast<double>(cells.height)};
    for (const double value : cells.origin) all.push_back(value);
    for (const std::int8_t value : cells.values) all.push_back(value);
    return all;
}

inline std::vector<double> point_values(const Cloud& cloud) {
    std::vector<double> all;
    for (const char* name : {"x", "y", "z", "intensity"}) {
        const std::vector<double> column = values(cloud, *cloud.find(name));
        all.resize(4 * column.size());
        const auto first = static_cast<std::size_t>(name[0] == 'i' ? 3 : name[0] - 'x');
        for (std::size_t i = 0; i < column.size(); ++i) all[4 * i + first] = column[i];
    }
    return all;
}

inline std::vector<double> pose_values(const Pose& pose) {
    const Eigen::Quaterniond turn(pose.linear());
    const Eigen::Vector3d at = pose.translation();
    return {at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w()};
}

}  // namespace dynamic_filter::io
