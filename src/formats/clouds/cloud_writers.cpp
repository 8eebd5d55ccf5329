// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/clouds/field_types.hpp"
#include "formats/clouds/registry.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::array bin_names = {"x", "y", "z", "intensity"};

void require_coordinates(const std::filesystem::path& path, const Cloud& cloud) {
    for (const char* name : {"x", "y", "z"}) {
        if (cloud.find(name) == nullptr) {
            throw OutputError(path, fmt::format("the cloud has no field '{}'", name));
        }
    }
}

bool is_wide_integer(FieldType type) { return type == FieldType::i64 || type == FieldType::u64; }

/// True if float32 represents every value of the type exactly.
bool fits_float(FieldType type) { return size_of(type) <= 2 || type == FieldType::f32; }

std::string ply_type(FieldType type) {
    static const std::array names = {"char", "uchar",  "short",  "ushort", "int",
                                     "uint", "double", "double", "float",  "double"};
    return names[static_cast<std::size_t>(type)];
}

std::string names_of(const std::vector<Field>& fields) {
    std::string names;
    for (const Field& field : fields) names += (names.empty() ? "" : ", ") + field.name;
    return names;
}

std::vector<Field> wide_integers(const std::vector<Field>& fields) {
    std::vector<Field> wide;
    std::copy_if(fields.begin(), fields.end(), std::back_inserter(wide),
                 [](const Field& field) { return is_wide_integer(field.type); });
    return wide;
}

std::string rounding_note(const std::vector<Field>& wide) {
    return wide.empty() ? "" : "64-bit integers are rounded to doubles: " + names_of(wide);
}

/// The order x, y, z, intensity, other fields. The entry for intensity is empty if there is none.
std::vector<std::optional<Field>> in_bin_order(const std::vector<Field>& fields) {
    std::vector<std::optional<Field>> ordered(bin_names.size());
    for (const Field& field : fields) {
        const auto name = std::find(bin_names.begin(), bin_names.end(), field.name);
        if (name == bin_names.end()) {
            ordered.emplace_back(field);
        } else {
            ordered[static_cast<std::size_t>(name - bin_names.begin())] = field;
        }
    }
    if (ordered.size() == bin_names.size() && !ordered.back()) ordered.pop_back();
    return ordered;
}

/// One row of values of type T per point; missing fields are 0.
template <class T>
std::vector<T> matrix_of(const Cloud& cloud, const std::vector<std::optional<Field>>& columns) {
    std::vector<T> rows(cloud.size() * columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (!columns[c]) continue;
        const std::vector<double> column = values(cloud, *columns[c]);
        for (std::size_t i = 0; i < column.size(); ++i) {
            rows[i * columns.size() + c] = static_cast<T>(column[i]);
        }
    }
    return rows;
}

template <class T>
void write_matrix(AtomicFile& file, const Cloud& cloud,
                  const std::vector<std::optional<Field>>& columns) {
    const std::vector<T> rows = matrix_of<T>(cloud, columns);
    file.write(std::as_bytes(std::span(rows)));
}

std::string npy_header(bool narrow, std::size_t rows, std::size_t columns) {
    constexpr std::size_t preamble = 10, alignment = 64;
    std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   narrow ? "<f4" : "<f8", rows, columns);
    while ((preamble + text.size() + 1) % alignment != 0) text += ' ';
    text += '\n';
    const auto length = static_cast<char>(text.size());  // the text has at most two short lines
    return std::string("\x93NUMPY\x01\x00", 8) + length + '\0' + text;
}

std::string npy_note(const std::vector<std::optional<Field>>& columns) {
    std::string names;
    std::vector<Field> present;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (columns[c]) present.push_back(*columns[c]);
        if (c < bin_names.size()) continue;
        names += fmt::format("{}{} is column {}", names.empty() ? "" : ", ", columns[c]->name, c);
    }
    const std::string rounded = rounding_note(wide_integers(present));
    if (names.empty()) return rounded;
    return "an array has no names: " + names + (rounded.empty() ? "" : "; ") + rounded;
}

}  // namespace

std::string write_ply(const std::filesystem::path& path, const Cloud& cloud) {
    require_coordinates(path, cloud);
    const std::vector<Field> fields = single_fields(cloud);
    std::string header =
        fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", cloud.size());
    for (const Field& field : fields) {
        header += "property " + ply_type(field.type) + " " + field.name + "\n";
    }
    const std::vector<Field> wide = wide_integers(fields);
    std::vector<std::byte> body = cloud.data;
    for (const Field& field : wide) {  // they have the same size as a double
        const std::vector<double> column = values(cloud, field);
        for (std::size_t i = 0; i < column.size(); ++i) {
            store_at(body.data() + i * cloud.point_bytes + field.offset, column[i]);
        }
    }
    AtomicFile file(path);
    file.write(header + "end_header\n");
    file.write(body);
    file.commit();
    return rounding_note(wide);
}

std::string write_npy(const std::filesystem::path& path, const Cloud& cloud) {
    require_coordinates(path, cloud);
    const std::vector<Field> fields = single_fields(cloud);
    const auto columns = in_bin_order(fields);
    const bool narrow = std::all_of(fields.begin(), fields.end(),
                                    [](const Field& field) { return fits_float(field.type); });
    AtomicFile file(path);
    file.write(npy_header(narrow, cloud.size(), columns.size()));
    if (narrow) {
        write_matrix<float>(file, cloud, columns);
    } else {
        write_matrix<double>(file, cloud, columns);
    }
    file.commit();
    return npy_note(columns);
}

std::string write_bin(const std::filesystem::path& path, const Cloud& cloud) {
    require_coordinates(path, cloud);
    auto columns = in_bin_order(single_fields(cloud));
    std::vector<Field> lost, narrowed;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (!columns[c]) continue;
        if (c >= bin_names.size()) {
            lost.push_back(*columns[c]);
        } else if (!fits_float(columns[c]->type)) {
            narrowed.push_back(*columns[c]);
        }
    }
    columns.resize(bin_names.size());
    AtomicFile file(path);
    write_matrix<float>(file, cloud, columns);
    file.commit();
    std::string note;
    if (!narrowed.empty()) note = "rounded to float32: " + names_of(narrowed);
    if (!lost.empty()) note += (note.empty() ? "" : "; ") + ("left out: " + names_of(lost));
    return note;
}

bool can_write_cloud(const std::filesystem::path& path) {
    const CloudFormat* format = cloud_format_of(path);
    return format != nullptr && format->write != nullptr;
}

std::string cloud_kinds_written() { return cloud_extensions(Purpose::write); }

Written write_cloud(const std::filesystem::path& path, const Cloud& cloud) {
    if (can_write_cloud(path)) return cloud_format_of(path)->write(path, cloud);
    throw OutputError(path, "unknown kind of cloud; expected " + cloud_kinds_written());
}

}  // namespace dynamic_filter::io
