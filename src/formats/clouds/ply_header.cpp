// SPDX-License-Identifier: MIT
#include "formats/clouds/ply_header.hpp"

#include <algorithm>
#include <map>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {
namespace {

using Tokens = std::vector<std::string_view>;

FieldType field_type(std::string_view name, const Lines& lines) {
    static const std::map<std::string, FieldType, std::less<>> types = {
        {"char", FieldType::i8},     {"int8", FieldType::i8},     {"uchar", FieldType::u8},
        {"uint8", FieldType::u8},    {"short", FieldType::i16},   {"int16", FieldType::i16},
        {"ushort", FieldType::u16},  {"uint16", FieldType::u16},  {"int", FieldType::i32},
        {"int32", FieldType::i32},   {"uint", FieldType::u32},    {"uint32", FieldType::u32},
        {"float", FieldType::f32},   {"float32", FieldType::f32}, {"double", FieldType::f64},
        {"float64", FieldType::f64}, {"int64", FieldType::i64},   {"uint64", FieldType::u64}};
    const auto found = types.find(name);
    if (found == types.end()) lines.fail(quote(name) + " is no PLY type");
    return found->second;
}

PlyFormat format_of(const Tokens& tokens, const Lines& lines) {
    const std::string_view name = tokens.size() > 1 ? tokens[1] : "";
    if (name == "ascii") return PlyFormat::ascii;
    if (name == "binary_little_endian") return PlyFormat::little;
    if (name == "binary_big_endian") return PlyFormat::big;
    lines.fail("format " + quote(name) +
               "; expected ascii, binary_little_endian or binary_big_endian");
}

PlyElement element_of(const Tokens& tokens, const Lines& lines) {
    if (tokens.size() != 3) lines.fail("expected 'element NAME COUNT'");
    const auto count = parse_count(tokens[2]);
    if (!count) lines.fail(quote(tokens[2]) + " is no count; expected plain digits");
    return {std::string(tokens[1]), *count, {}};
}

PlyProperty property_of(const Tokens& tokens, const Lines& lines) {
    if (tokens.size() == 3) return {{std::string(tokens[2]), field_type(tokens[1], lines)}, {}};
    if (tokens.size() != 5 || tokens[1] != "list") {
        lines.fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
    const FieldType length = field_type(tokens[2], lines);
    if (length == FieldType::f32 || length == FieldType::f64) {
        lines.fail("the length of a list must be an integer");
    }
    return {{std::string(tokens[4]), field_type(tokens[3], lines)}, length};
}

PlyHeader finish(PlyFormat format, std::vector<PlyElement> elements, const Lines& lines) {
    const auto vertex = std::find_if(elements.begin(), elements.end(),
                                     [](const PlyElement& e) { return e.name == "vertex"; });
    if (vertex == elements.end()) throw InputError(lines.file(), "header", "no element 'vertex'");
    PlyHeader header{.format = format,
                     .before = {elements.begin(), vertex},
                     .points = vertex->count,
                     .columns = {},
                     .properties = vertex->properties};
    for (const PlyProperty& property : vertex->properties) {
        const std::string axis = to_lower(property.column.name);
        if (property.list_count && (axis == "x" || axis == "y" || axis == "z")) {
            throw InputError(lines.file(), "header",
                             "vertex property " + quote(property.column.name) +
                                 " is a list; expected plain numbers");
        }
        header.has_lists |= property.list_count.has_value();
        if (!property.list_count) header.columns.push_back(property.column);
    }
    name_in_small_letters(header.columns);
    return header;
}

}  // namespace

PlyHeader parse_ply_header(Lines& lines) {
    if (!lines.next() || trim(lines.line()) != "ply") {
        throw InputError(lines.file(), "byte 0", "does not begin with 'ply'");
    }
    std::optional<PlyFormat> format;
    std::vector<PlyElement> elements;
    while (lines.next()) {
        const Tokens tokens = split_tokens(lines.line());
        if (tokens.empty() || tokens[0] == "comment" || tokens[0] == "obj_info") continue;
        if (tokens[0] == "format") {
            format = format_of(tokens, lines);
        } else if (tokens[0] == "element") {
            elements.push_back(element_of(tokens, lines));
        } else if (tokens[0] == "property") {
            if (elements.empty()) lines.fail("a property before the first element");
            elements.back().properties.push_back(property_of(tokens, lines));
        } else if (tokens[0] == "end_header") {
            if (!format) lines.fail("the header has no format line");
            return finish(*format, std::move(elements), lines);
        } else {
            lines.fail(quote(tokens[0]) + " is no PLY header line");
        }
    }
    throw InputError(lines.file(), "byte " + std::to_string(lines.offset()),
                     "ends before end_header; the file is truncated");
}

}  // namespace dynamic_filter::io
