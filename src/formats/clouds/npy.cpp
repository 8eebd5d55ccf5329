// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
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
    std::vector<Column> columns;  ///< of a structured array; otherwise empty
    FieldType type = FieldType::f32;
    bool big_endian = false;
    bool column_by_column = false;  ///< true: all x come before all y
    std::uint64_t rows = 0, count = 0;
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

std::optional<FieldType> numpy_type(std::string_view code) {
    static const std::map<std::string, FieldType, std::less<>> types = {
        {"i1", FieldType::i8},  {"u1", FieldType::u8},  {"b1", FieldType::u8},
        {"i2", FieldType::i16}, {"u2", FieldType::u16}, {"i4", FieldType::i32},
        {"u4", FieldType::u32}, {"i8", FieldType::i64}, {"u8", FieldType::u64},
        {"f4", FieldType::f32}, {"f8", FieldType::f64}};
    const auto found = types.find(code);
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

/// Reads [('x', '<f4'), ('y', '<f4'), ...], the fields of a structured array.
class FieldList {
public:
    explicit FieldList(std::string_view text) : text_(text) {}

    void read(NpyHeader& header) {
        expect('[');
        while (!skip(']')) {
            expect('(');
            const std::string name(quoted());
            expect(',');
            add(header, name, quoted());
            if (skip(',') && !peek(')')) throw Malformed(in_array(name));
            expect(')');
            (void)skip(',');
        }
        if (header.columns.empty()) throw Malformed("the structured array has no fields");
    }

private:
    static std::string in_array(const std::string& name) {
        return "field " + quote(name) +
               " of the structured array is itself an array, or has a "
               "title; expected one number for each field";
    }

    void add(NpyHeader& header, const std::string& name, std::string_view code) {
        const char order = code.empty() ? ' ' : code.front();
        const std::string_view kind = code.substr(std::min<std::size_t>(1, code.size()));
        if (kind.starts_with('V') && name.empty()) {
            const auto bytes = parse_count(kind.substr(1));
            if (!bytes || *bytes > most_padding) throw Malformed("padding of " + quote(code));
            if (*bytes > 0)
                header.columns.push_back(
                    {"_", FieldType::u8, static_cast<std::uint32_t>(*bytes), true});
            return;
        }
        const auto type = numpy_type(kind);
        if (!type || std::string_view("<>|").find(order) == std::string_view::npos) {
            throw Malformed("field " + quote(name) + " has values of type " + quote(code) +
                            "; expected integers, float32 or float64");
        }
        if (header.columns.size() == most_columns) throw Malformed("too many fields");
        if (order != '|') {
            if (has_order_ && header.big_endian != (order == '>'))
                throw Malformed("has fields of both byte orders; save them in one");
            header.big_endian = order == '>';
            has_order_ = true;
        }
        header.columns.push_back({name, *type});
    }

    bool peek(char c) {
        text_ = trim(text_);
        return text_.starts_with(c);
    }
    bool skip(char c) {
        if (!peek(c)) return false;
        text_.remove_prefix(1);
        return true;
    }
    void expect(char c) {
        if (!skip(c)) throw Malformed("the list of fields is cut off, or no list of pairs");
    }
    std::string_view quoted() {
        const bool is_single = peek('\'');
        const std::size_t end = text_.find(is_single ? '\'' : '"', 1);
        if ((!is_single && !peek('"')) || end == std::string_view::npos)
            throw Malformed("the list of fields has no text in quotes where it must have one");
        const std::string_view inner = text_.substr(1, end - 1);
        text_.remove_prefix(end + 1);
        return inner;
    }

    static constexpr std::uint64_t most_padding = 1 << 16;
    std::string_view text_;
    bool has_order_ = false;
};

void read_type(NpyHeader& header, std::string_view value) {
    if (value.starts_with('[')) {
        FieldList(value).read(header);
        return name_in_small_letters(header.columns);
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

/// The numbers of a tuple. Throws for other text.
std::vector<std::uint64_t> sizes_in(std::string_view value) {
    const std::size_t end = value.find(')');
    if (!value.starts_with('(') || end == std::string_view::npos) {
        throw Malformed("the header's 'shape' is no tuple");
    }
    auto texts = split_at(value.substr(1, end - 1), ',');
    if (texts.back().empty()) texts.pop_back();
    std::vector<std::uint64_t> sizes;
    for (const auto text : texts) {
        const auto size = parse_count(text);
        if (!size) throw Malformed("an array of shape " + quote(value.substr(0, end + 1)));
        sizes.push_back(*size);
    }
    return sizes;
}

/// True for an array with x, y, z... as its rows, such as 4 x 20000: no cloud has so few points
/// with so many fields.
bool is_sideways(std::uint64_t first, std::uint64_t second) {
    constexpr std::uint64_t most_fields = 8, fewest_points = 32;
    return first >= 3 && first <= most_fields && second >= fewest_points;
}

void read_shape(NpyHeader& header, std::string_view value, bool is_fortran) {
    const std::vector<std::uint64_t> sizes = sizes_in(value);
    if (!header.columns.empty()) {  // of any shape: each entry is a point
        header.rows = 1;
        for (const std::uint64_t size : sizes) {
            const auto rows = product(header.rows, size);
            if (!rows) throw Malformed("its shape overflows");
            header.rows = *rows;
        }
        return;
    }
    const bool is_flat = sizes.size() == 2;
    const bool sideways = is_flat && is_sideways(sizes[0], sizes[1]);
    const std::uint64_t columns = is_flat ? sizes[sideways ? 0 : 1] : 0;
    if (columns < 3 || columns > most_columns) {
        throw Malformed(
            fmt::format("an array of shape {}; expected N x k, k from 3 to {}: x y z "
                        "[intensity ...]",
                        quote(value.substr(0, value.find(')') + 1)), most_columns));
    }
    header.rows = sizes[sideways ? 1 : 0];
    header.count = columns;
    header.column_by_column = sideways != is_fortran;
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
    const bool is_fortran = value_of(dictionary, "fortran_order").starts_with("True");
    read_shape(header, value_of(dictionary, "shape"), is_fortran);
    return header;
}

std::vector<Column> columns_of(const NpyHeader& header) {
    if (!header.columns.empty()) return header.columns;
    static const std::array names = {"x", "y", "z", "intensity"};
    std::vector<Column> columns;
    for (std::size_t i = 0; i < header.count; ++i) {
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
    const std::size_t stride = record_bytes(columns);
    const std::size_t present = (bytes.size() - header.begin) / stride;
    if (header.rows > present) {
        throw InputError(file, fmt::format("byte {}", bytes.size()),
                         fmt::format("ends after {} of {} points of {} bytes; it is truncated",
                                     present, header.rows, stride));
    }
    if (header.column_by_column) {
        read_columns(cloud, columns, header.rows, std::span(bytes).subspan(header.begin));
    } else {
        read_rows(cloud, columns, header.rows, std::move(bytes), header.begin);
    }
    if (header.big_endian) swap_bytes(cloud);
    return with_real_coordinates(std::move(cloud));
}

}  // namespace dynamic_filter::io
