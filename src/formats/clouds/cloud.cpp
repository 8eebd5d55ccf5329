// SPDX-License-Identifier: MIT
#include "dynamic_filter/cloud.hpp"

#include <algorithm>
#include <cstring>

#include "base/input.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/cloud_size.hpp"
#include "formats/clouds/registry.hpp"

namespace dynamic_filter::io {
namespace {

template <typename T>
void gather(const Cloud& cloud, const Field& field, std::vector<double>& out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        T raw{};
        std::memcpy(&raw, cloud.data.data() + i * cloud.point_bytes + field.offset, sizeof raw);
        out[i] = static_cast<double>(raw);
    }
}

const Field& coordinate(const Cloud& cloud, const char* name) {
    const Field* field = cloud.find(name);
    if (field == nullptr) throw Error(std::string("the cloud has no field '") + name + "'");
    return *field;
}

}  // namespace

std::size_t size_of(FieldType type) {
    switch (type) {
        case FieldType::i8:
        case FieldType::u8:
            return 1;
        case FieldType::i16:
        case FieldType::u16:
            return 2;
        case FieldType::i32:
        case FieldType::u32:
        case FieldType::f32:
            return 4;
        case FieldType::i64:
        case FieldType::u64:
        case FieldType::f64:
            break;
    }
    return 8;
}

const Field* Cloud::find(const std::string& name) const {
    const auto found = std::find_if(fields.begin(), fields.end(),
                                    [&](const Field& field) { return field.name == name; });
    return found == fields.end() ? nullptr : &*found;
}

void add_field(Cloud& cloud, const std::string& name, FieldType type, std::uint32_t count) {
    if (!cloud.data.empty()) throw Error("field '" + name + "' added to a cloud that has points");
    cloud.fields.push_back({name, type, count, static_cast<std::uint32_t>(cloud.point_bytes)});
    cloud.point_bytes += size_of(type) * count;
}

std::vector<double> values(const Cloud& cloud, const Field& field) {
    std::vector<double> out(cloud.size());
    switch (field.type) {
        case FieldType::i8:
            gather<std::int8_t>(cloud, field, out);
            break;
        case FieldType::u8:
            gather<std::uint8_t>(cloud, field, out);
            break;
        case FieldType::i16:
            gather<std::int16_t>(cloud, field, out);
            break;
        case FieldType::u16:
            gather<std::uint16_t>(cloud, field, out);
            break;
        case FieldType::i32:
            gather<std::int32_t>(cloud, field, out);
            break;
        case FieldType::u32:
            gather<std::uint32_t>(cloud, field, out);
            break;
        case FieldType::i64:
            gather<std::int64_t>(cloud, field, out);
            break;
        case FieldType::u64:
            gather<std::uint64_t>(cloud, field, out);
            break;
        case FieldType::f32:
            gather<float>(cloud, field, out);
            break;
        case FieldType::f64:
            gather<double>(cloud, field, out);
            break;
    }
    return out;
}

Points positions(const Cloud& cloud) {
    const Field* axes[] = {&coordinate(cloud, "x"), &coordinate(cloud, "y"),
                           &coordinate(cloud, "z")};
    Points points(cloud.size());
    if (points.empty()) return points;
    for (int axis = 0; axis < 3; ++axis) {
        const Field& field = *axes[axis];
        if (field.type == FieldType::f32) {
            const std::byte* from = cloud.data.data() + field.offset;
            for (Point& point : points) {
                std::memcpy(&point[axis], from, sizeof(float));
                from += cloud.point_bytes;
            }
        } else {
            const std::vector<double> wide = values(cloud, field);
            for (std::size_t i = 0; i < wide.size(); ++i) {
                points[i][axis] = static_cast<float>(wide[i]);
            }
        }
    }
    return points;
}

void refuse_bad_size(const std::filesystem::path& file) {
    std::error_code unknown;  // the reader reports the error
    const auto bytes = std::filesystem::file_size(file, unknown);
    if (unknown) return;
    const CloudFormat* format = cloud_format_of(file);
    if (format != nullptr && format->refuse_bad_size != nullptr) {
        format->refuse_bad_size(file, static_cast<std::size_t>(bytes));
    }
    if (bytes == 0) throw InputError(file, "byte 0", "is empty; expected a point cloud");
}

Cloud read_cloud(const std::filesystem::path& file) {
    if (const CloudFormat* format = cloud_format_of(file)) return format->read(file);
    const bool is_arrow = to_lower(file.extension().string()) == ".feather";
    throw InputError(
        file, "",
        "unknown kind of cloud; expected " + cloud_extensions(Purpose::read) +
            (is_arrow ? "; docs/formats.md has the lines that convert Argoverse 2" : ""));
}

}  // namespace dynamic_filter::io
