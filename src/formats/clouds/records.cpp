// SPDX-License-Identifier: MIT
#include "formats/clouds/records.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_set>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {
namespace {

void check_coordinate(const Cloud& cloud, const std::string& name,
                      const std::filesystem::path& file) {
    const Field* field = cloud.find(name);
    if (field == nullptr) {
        throw InputError(file, "header",
                         "has no field '" + name + "'; a point cloud needs x, y, z");
    }
    if (field->count != 1) {
        throw InputError(file, "header",
                         "field '" + name + "' has " + std::to_string(field->count) +
                             " values a point; a coordinate is one number");
    }
}

template <typename T>
bool parse_integer(std::string_view token, T& value) {
    const char* const end = token.data() + token.size();
    const auto result = std::from_chars(token.data(), end, value);
    if (result.ec == std::errc{} && result.ptr == end) return true;
    // Some programs write every column as a float; "3.0" is accepted as the integer 3.
    const auto real = parse_real(token);
    if (!real || *real != std::trunc(*real)) return false;
    const double limit = std::ldexp(1.0, std::numeric_limits<T>::digits);
    if (!(*real < limit && *real >= (std::is_signed_v<T> ? -limit : 0.0))) return false;
    value = static_cast<T>(*real);
    return true;
}

bool parse_float(std::string_view token, float& value) {
    const auto real = parse_real(token);
    if (!real) return false;
    if (std::isfinite(*real) && std::abs(*real) > std::numeric_limits<float>::max()) return false;
    value = static_cast<float>(*real);
    return true;
}

template <typename T>
bool store(std::string_view token, std::byte* to) {
    T value{};
    bool good = false;
    if constexpr (std::is_same_v<T, float>) {
        good = parse_float(token, value);
    } else if constexpr (std::is_same_v<T, double>) {
        const auto real = parse_real(token);
        good = real.has_value();
        value = real.value_or(0.0);
    } else {
        good = parse_integer(token, value);
    }
    std::memcpy(to, &value, sizeof value);
    return good;
}

bool store(std::string_view token, FieldType type, std::byte* to) {
    switch (type) {
        case FieldType::i8:
            return store<std::int8_t>(token, to);
        case FieldType::u8:
            return store<std::uint8_t>(token, to);
        case FieldType::i16:
            return store<std::int16_t>(token, to);
        case FieldType::u16:
            return store<std::uint16_t>(token, to);
        case FieldType::i32:
            return store<std::int32_t>(token, to);
        case FieldType::u32:
            return store<std::uint32_t>(token, to);
        case FieldType::i64:
            return store<std::int64_t>(token, to);
        case FieldType::u64:
            return store<std::uint64_t>(token, to);
        case FieldType::f32:
            return store<float>(token, to);
        case FieldType::f64:
            return store<double>(token, to);
    }
    return false;
}

std::uint64_t values_per_line(const std::vector<Column>& columns) {
    std::uint64_t values = 0;
    for (const Column& column : columns) values += column.count;
    return values;
}

void read_line(const std::vector<Column>& columns, const Lines& lines, std::byte* to) {
    std::string_view rest = lines.line();
    std::uint64_t seen = 0;
    for (const Column& column : columns) {
        for (std::uint32_t i = 0; i < column.count; ++i, ++seen) {
            const std::string_view token = next_token(rest);
            if (token.empty()) {
                lines.fail("has " + std::to_string(seen) + " values; the header promises " +
                           std::to_string(values_per_line(columns)));
            }
            if (column.padding) continue;
            if (!store(token, column.type, to)) {
                lines.fail(quote(token) + " is no value for field " + quote(column.name));
            }
            to += size_of(column.type);
        }
    }
    if (!next_token(rest).empty()) {
        lines.fail("has more values than the " + std::to_string(seen) + " the header promises");
    }
}

bool next_filled_line(Lines& lines) {
    while (lines.next()) {
        if (!trim(lines.line()).empty()) return true;
    }
    return false;
}

/// Copies `bytes` of each point between two strided arrays. Usual sizes have a version with a fixed
/// size, which is faster.
void copy_strided(const std::byte* from, std::size_t from_stride, std::byte* to,
                  std::size_t to_stride, std::size_t bytes, std::size_t points) {
    const auto copy = [&](auto size) {
        for (std::size_t i = 0; i < points; ++i) {
            std::memcpy(to + i * to_stride, from + i * from_stride, size);
        }
    };
    if (bytes == 4) return copy(std::integral_constant<std::size_t, 4>{});
    if (bytes == 16) return copy(std::integral_constant<std::size_t, 16>{});
    copy(bytes);
}

}  // namespace

std::size_t column_bytes(const Column& column) { return size_of(column.type) * column.count; }

std::size_t record_bytes(const std::vector<Column>& columns) {
    std::size_t bytes = 0;
    for (const Column& column : columns) bytes += column_bytes(column);
    return bytes;
}

void name_in_small_letters(std::vector<Column>& columns) {
    const auto find = [&](const std::string& name) {
        return std::find_if(columns.begin(), columns.end(),
                            [&](const Column& column) { return column.name == name; });
    };
    for (const char* name : {"x", "y", "z", "intensity"}) {
        if (find(name) != columns.end()) continue;
        for (Column& column : columns) {
            if (to_lower(column.name) != name) continue;
            column.name = name;
            break;
        }
    }
}

Cloud empty_cloud(const std::vector<Column>& columns, const std::filesystem::path& file) {
    Cloud cloud;
    std::unordered_set<std::string> names;
    for (const Column& column : columns) {
        if (column.padding) continue;
        if (!names.insert(column.name).second) {
            throw InputError(file, "header", "has two fields named " + quote(column.name));
        }
        add_field(cloud, column.name, column.type, column.count);
    }
    for (const char* name : {"x", "y", "z"}) check_coordinate(cloud, name, file);
    return cloud;
}

void read_ascii(Cloud& cloud, const std::vector<Column>& columns, std::uint64_t points,
                Lines& lines) {
    const auto expected = product(points, values_per_line(columns));
    const std::size_t left = lines.text().size() - lines.offset();
    // A value takes at least one digit and a separator, so the length of the text limits the
    // memory.
    if (expected && *expected <= (left + 1) / 2) cloud.data.reserve(points * cloud.point_bytes);
    for (std::uint64_t point = 0; point < points; ++point) {
        if (!next_filled_line(lines)) {
            throw InputError(lines.file(), "byte " + std::to_string(lines.offset()),
                             "ends after " + std::to_string(point) + " of " +
                                 std::to_string(points) + " points; the file is truncated");
        }
        cloud.data.resize(cloud.data.size() + cloud.point_bytes);
        read_line(columns, lines, cloud.data.data() + cloud.data.size() - cloud.point_bytes);
    }
}

void read_rows(Cloud& cloud, const std::vector<Column>& columns, std::size_t points,
               std::vector<std::byte>&& bytes, std::size_t offset) {
    const std::size_t stride = record_bytes(columns);
    // Without padding, the bytes of the file are those of the cloud.
    if (stride == cloud.point_bytes) {
        bytes.resize(offset + points * stride);
        bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
        cloud.data = std::move(bytes);
        return;
    }
    if (points == 0) return;
    cloud.data.resize(points * cloud.point_bytes);
    std::size_t from = offset, to = 0;
    for (std::size_t c = 0; c < columns.size();) {  // adjacent columns are copied together
        std::size_t run = 0;
        for (; c < columns.size() && !columns[c].padding; ++c) run += column_bytes(columns[c]);
        if (run > 0)
            copy_strided(bytes.data() + from, stride, cloud.data.data() + to, cloud.point_bytes,
                         run, points);
        from += run;
        to += run;
        for (; c < columns.size() && columns[c].padding; ++c) from += column_bytes(columns[c]);
    }
}

void read_columns(Cloud& cloud, const std::vector<Column>& columns, std::size_t points,
                  std::span<const std::byte> block) {
    if (points == 0) return;
    cloud.data.resize(points * cloud.point_bytes);
    std::size_t from = 0, to = 0;
    for (const Column& column : columns) {
        const std::size_t bytes = column_bytes(column);
        if (!column.padding) {
            copy_strided(block.data() + from, bytes, cloud.data.data() + to, cloud.point_bytes,
                         bytes, points);
            to += bytes;
        }
        from += bytes * points;
    }
}

Cloud with_real_coordinates(Cloud cloud) {
    const auto is_real = [&](const char* name) {
        const FieldType type = cloud.find(name)->type;
        return type == FieldType::f32 || type == FieldType::f64;
    };
    if (is_real("x") && is_real("y") && is_real("z")) return cloud;
    const auto is_axis = [](const Field& field) {
        return field.name == "x" || field.name == "y" || field.name == "z";
    };
    Cloud real;
    real.viewpoint = cloud.viewpoint;
    for (const Field& field : cloud.fields)
        add_field(real, field.name, is_axis(field) ? FieldType::f64 : field.type, field.count);
    real.data.resize(cloud.size() * real.point_bytes);
    for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
        const Field& from = cloud.fields[f];
        std::byte* const to = real.data.data() + real.fields[f].offset;
        if (is_axis(from)) {
            const std::vector<double> wide = values(cloud, from);
            copy_strided(reinterpret_cast<const std::byte*>(wide.data()), sizeof(double), to,
                         real.point_bytes, sizeof(double), wide.size());
        } else {
            copy_strided(cloud.data.data() + from.offset, cloud.point_bytes, to, real.point_bytes,
                         size_of(from.type) * from.count, cloud.size());
        }
    }
    return real;
}

void swap_bytes(Cloud& cloud) {
    for (const Field& field : cloud.fields) {
        const std::size_t size = size_of(field.type);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            std::byte* value = cloud.data.data() + i * cloud.point_bytes + field.offset;
            for (std::uint32_t n = 0; n < field.count; ++n, value += size) {
                std::reverse(value, value + size);
            }
        }
    }
}

}  // namespace dynamic_filter::io
