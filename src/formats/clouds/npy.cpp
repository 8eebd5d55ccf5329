// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <optional>

#include "base/input.hpp"
#include "base/text.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/byte_reader.hpp"
#include "formats/clouds/records.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::uint64_t most_columns = 1024;

struct NpyHeader {
    FieldType type = FieldType::f32;
    bool big_endian = false;
    std::uint64_t rows = 0, columns = 0;
    std::size_t begin = 0;  ///< [bytes] offset of the values
};

/// The text after a key of the dictionary in the header, up to the end of the header.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
    for (const char mark : {'\'', '"'}) {
        const std::string quoted = mark + std::string(key) + mark;
        const std::size_t at = dictionary.find(quoted);
        if (at == std::string_view::npos) continue;
        const std::string_view rest = trim(dictionary.substr(at + quoted.size()));
        if (rest.starts_with(':')) return trim(rest.substr(1));
    }
    throw Malformed("the header has no " + quote(key));
}

void read_type(NpyHeader& header, std::string_view value) {
    if (value.starts_with('[')) {
        throw Malformed(
            "a structured array is not read; save a plain one with x y z [intensity] as columns");
    }
    if (value.size() < 5) throw Malformed("the header's 'descr' is cut off");
    const std::string_view code = value.substr(1, value.find(value[0], 1) - 1);
    if (code == "<f4" || code == ">f4") {
        header.type = FieldType::f32;
    } else if (code == "<f8" || code == ">f8") {
        header.type = FieldType::f64;
    } else {
        throw Malformed("values of type " + quote(code) +
                        " are not read; save float32 or float64 (astype)");
    }
    header.big_endian = code[0] == '>';
}

void read_shape(NpyHeader& header, std::string_view value) {
    const std::size_t end = value.find(')');
    if (!value.starts_with('(') || end == std::string_view::npos) {
        throw Malformed("the header's 'shape' is no tuple");
    }
    auto sizes = split_at(value.substr(1, end - 1), ',');
    if (sizes.back().empty()) sizes.pop_back();
    const auto rows = sizes.empty() ? std::nullopt : parse_count(sizes[0]);
    const auto columns = sizes.size() == 2 ? parse_count(sizes[1]) : std::nullopt;
    if (!rows || !columns || *columns < 3 || *columns > most_columns) {
        throw Malformed(
            fmt::format("an array of shape {}; expected N x k, k from 3 to {}: x y z "
                        "[intensity ...]",
                        quote(value.substr(0, end + 1)), most_columns));
    }
    header.rows = *rows;
    header.columns = *columns;
}

NpyHeader parse_header(std::span<const std::byte> bytes) {
    ByteReader reader(bytes);
    if (reader.text(6) != "\x93NUMPY") throw Malformed("does not begin as .npy files do");
    const auto version = reader.number<std::uint8_t>();
    reader.read(1);
    if (version < 1 || version > 3) {
        throw Malformed(fmt::format("version {} of .npy is unknown; 1 to 3 are read", version));
    }
    const std::uint64_t length =
        version == 1 ? reader.number<std::uint16_t>() : reader.number<std::uint32_t>();
    const std::string_view dictionary = reader.text(length);
    NpyHeader header;
    header.begin = reader.at();
    read_type(header, value_of(dictionary, "descr"));
    if (!value_of(dictionary, "fortran_order").starts_with("False")) {
        throw Malformed(
            "an array in Fortran order is not read; save numpy.ascontiguousarray of it");
    }
    read_shape(header, value_of(dictionary, "shape"));
    return header;
}

std::vector<Column> columns_of(const NpyHeader& header) {
    static const std::array names = {"x", "y", "z", "intensity"};
    std::vector<Column> columns;
    for (std::size_t i = 0; i < header.columns; ++i) {
        columns.push_back({i < names.size() ? names[i] : fmt::format("c{}", i), header.type});
    }
    return columns;
}

}  // namespace

Cloud read_npy(const std::filesystem::path& file) {
    std::vector<std::byte> bytes = read_bytes(file);
    NpyHeader header;
    try {
        header = parse_header(bytes);
    } catch (const Malformed& error) {
        throw InputError(file, "header", error.what());
    }
    const std::vector<Column> columns = columns_of(header);
    Cloud cloud = empty_cloud(columns, file);
    const std::size_t present = (bytes.size() - header.begin) / cloud.point_bytes;
    if (header.rows > present) {
        throw InputError(file, fmt::format("byte {}", bytes.size()),
                         fmt::format("ends after {} of {} points of {} bytes; it is truncated",
                                     present, header.rows, cloud.point_bytes));
    }
    read_rows(cloud, columns, header.rows, std::move(bytes), header.begin);
    if (header.big_endian) swap_bytes(cloud);
    return cloud;
}

}  // namespace dynamic_filter::io
