// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/input.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/field_types.hpp"
#include "formats/clouds/las_header.hpp"
#include "formats/clouds/records.hpp"

namespace dynamic_filter::io {
namespace {

/// Copies the values of one field of all points, from records of `stride` bytes.
class Copier {
public:
    Copier(Cloud& cloud, std::span<const std::byte> records, std::size_t stride)
        : cloud_(cloud), records_(records), stride_(stride) {}

    void copy(const LasField& from, const Field& to) {
        if (from.type == from.stored && from.bits == 8) {
            with_type(from.stored, [&]<class T>(std::type_identity<T>) {
                each<T, T>(from, to, [](T value) { return value; });
            });
        } else if (from.bits < 8) {
            const auto mask = (1U << from.bits) - 1U;
            each<std::uint8_t, std::uint8_t>(from, to, [&](unsigned value) {
                return static_cast<std::uint8_t>(value >> from.first_bit & mask);
            });
        } else {
            with_type(from.stored, [&]<class T>(std::type_identity<T>) { scale<T>(from, to); });
        }
    }

private:
    template <class T>
    void scale(const LasField& from, const Field& to) {
        const auto scaled = [&](T value) {
            return static_cast<double>(value) * from.scale + from.offset;
        };
        if (from.type == FieldType::f64) return each<T, double>(from, to, scaled);
        each<T, float>(from, to, [&](T value) { return static_cast<float>(scaled(value)); });
    }

    template <class From, class To, class F>
    void each(const LasField& from, const Field& to, const F& f) {
        for (std::size_t i = 0; i < cloud_.size(); ++i) {
            const From value = little_endian<From>(records_.data() + i * stride_ + from.at);
            store_at<To>(cloud_.data.data() + i * cloud_.point_bytes + to.offset, f(value));
        }
    }

    Cloud& cloud_;
    std::span<const std::byte> records_;
    std::size_t stride_;
};

}  // namespace

Cloud read_las(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    const LasHeader header = parse_las_header(bytes, file);
    const std::size_t present = (bytes.size() - header.begin) / header.record_bytes;
    if (header.points > present) {
        throw InputError(file, fmt::format("byte {}", bytes.size()),
                         fmt::format("ends after {} of {} points of {} bytes; it is truncated",
                                     present, header.points, header.record_bytes));
    }
    std::vector<Column> columns;
    for (const LasField& field : header.fields) columns.push_back({field.name, field.type});
    Cloud cloud = empty_cloud(columns, file);
    cloud.crs = header.crs;
    cloud.gps_time_is_adjusted = header.gps_time_is_adjusted;
    cloud.data.resize(header.points * cloud.point_bytes);
    Copier copier(cloud, std::span(bytes).subspan(header.begin), header.record_bytes);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        copier.copy(header.fields[i], cloud.fields[i]);
    }
    return cloud;
}

}  // namespace dynamic_filter::io
