// SPDX-License-Identifier: MIT
#include "recording/common_fields.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "dynamic_filter/poses.hpp"
#include "formats/clouds/time_field.hpp"

namespace dynamic_filter::io {
namespace {

constexpr const char* kTimes = "t";
constexpr const char* kSensor = "sensor";

bool is_coordinate(const std::string& name) { return name == "x" || name == "y" || name == "z"; }

/// How the records of a cloud become those of the common fields.
struct Copy {
    std::size_t from, to, bytes;
};

/// The field of the cloud with the name, type and count of this one; nullptr if it has none.
const Field* same_in(const Cloud& cloud, const Field& field) {
    const Field* const own = cloud.find(field.name);
    const bool is_same = own != nullptr && own->type == field.type && own->count == field.count;
    return is_same ? own : nullptr;
}

std::vector<Copy> copies_from(const Cloud& cloud, const std::vector<Field>& fields) {
    std::vector<Copy> copies;
    for (const Field& field : fields) {
        const Field* const own = same_in(cloud, field);
        if (own == nullptr || is_coordinate(field.name)) continue;
        copies.push_back({own->offset, field.offset, size_of(field.type) * field.count});
    }
    return copies;
}

}  // namespace

CommonFields common_fields(const std::vector<Cloud>& clouds, bool timed) {
    CommonFields common;
    common.with_times = timed;
    Cloud layout;
    for (const char* name : {"x", "y", "z"}) add_field(layout, name, FieldType::f32);
    const auto is_time = [&](const std::string& name) {
        return timed && std::any_of(clouds.begin(), clouds.end(), [&](const Cloud& cloud) {
                   const Field* const field = time_field(cloud);
                   return name == kTimes || (field != nullptr && field->name == name);
               });
    };
    std::vector<std::string> left_out;
    for (const Cloud& cloud : clouds) {
        for (const Field& field : cloud.fields) {
            const bool is_known = layout.find(field.name) != nullptr ||
                                  std::count(left_out.begin(), left_out.end(), field.name) > 0;
            if (is_known || is_time(field.name)) continue;
            const bool all = std::all_of(clouds.begin(), clouds.end(), [&](const Cloud& other) {
                return same_in(other, field) != nullptr;
            });
            if (all) {
                add_field(layout, field.name, field.type, field.count);
            } else {
                left_out.push_back(field.name);
                common.left_out += (common.left_out.empty() ? "" : ", ") + field.name;
            }
        }
    }
    if (timed) add_field(layout, kTimes, FieldType::f32);
    common.with_sensor = layout.find(kSensor) == nullptr;
    if (common.with_sensor) add_field(layout, kSensor, FieldType::u8);
    common.fields = std::move(layout.fields);
    return common;
}

Cloud in_common_fields(const Cloud& cloud, const std::vector<std::size_t>& points,
                       const CommonFields& fields, const Pose& T, double stamp,
                       std::size_t sensor) {
    Cloud out;
    out.fields = fields.fields;
    for (const Field& f : out.fields) out.point_bytes += size_of(f.type) * f.count;
    out.data.resize(points.size() * out.point_bytes);
    const std::vector<Copy> copies = copies_from(cloud, out.fields);
    const std::vector<float> times =
        fields.with_times ? point_times(cloud, stamp) : std::vector<float>{};
    const std::array<std::vector<double>, 3> at = {values(cloud, *cloud.find("x")),
                                                   values(cloud, *cloud.find("y")),
                                                   values(cloud, *cloud.find("z"))};
    const bool moves = !T.matrix().isIdentity(0.0);
    const Field *const time_at = fields.with_times ? out.find(kTimes) : nullptr,
                       *const sensor_at = fields.with_sensor ? out.find(kSensor) : nullptr;
    const auto number = static_cast<std::uint8_t>(sensor);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t i = points[k];
        std::byte* const record = out.data.data() + k * out.point_bytes;
        const std::byte* const own = cloud.data.data() + i * cloud.point_bytes;
        for (const Copy& copy : copies) std::memcpy(record + copy.to, own + copy.from, copy.bytes);
        Eigen::Vector3d p(at[0][i], at[1][i], at[2][i]);
        if (moves && !p.isZero(0.0)) p = T * p;
        const Eigen::Vector3f xyz = p.cast<float>();
        std::memcpy(record, xyz.data(), sizeof(float) * 3);
        if (time_at != nullptr && !times.empty()) {  // otherwise zero
            std::memcpy(record + time_at->offset, &times[i], sizeof(float));
        }
        if (sensor_at != nullptr) std::memcpy(record + sensor_at->offset, &number, sizeof number);
    }
    return out;
}

}  // namespace dynamic_filter::io
