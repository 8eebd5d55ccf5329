// SPDX-License-Identifier: MIT
#include <array>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/io/file.hpp"
#include "records.hpp"
#include "text.hpp"

namespace dynamic_filter::io {
namespace {

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with("//"); }

std::vector<Column> named(const std::vector<std::string_view>& names) {
    std::vector<Column> columns;
    for (const std::string_view name : names) columns.push_back({to_lower(name), FieldType::f64});
    return columns;
}

std::vector<Column> numbered(std::size_t count, const Lines& lines) {
    static const std::array names = {"x", "y", "z", "intensity"};
    if (count < 3) {
        lines.fail("has " + std::to_string(count) + " columns; a point is x y z [intensity ...]");
    }
    std::vector<Column> columns;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = i < names.size() ? names[i] : "c" + std::to_string(i);
        columns.push_back({name, FieldType::f64});
    }
    return columns;
}

struct Body {
    std::vector<Column> columns;
    std::size_t offset = 0;    ///< [bytes] of the first point's line
    std::uint64_t points = 0;  ///< lines that are left
};

/// Walks the text once: the names of the columns, and how many points follow.
Body survey(std::string_view text, const std::filesystem::path& file) {
    Body body;
    Lines lines(text, file);
    for (std::size_t begin = 0; lines.next(); begin = lines.offset()) {
        const std::string_view line = trim(lines.line());
        if (line.empty() || (body.points == 0 && is_comment(line))) continue;
        const auto cells = split_tokens(line);
        const bool numbers = parse_real(cells[0]).has_value();
        if (body.points == 0 && body.columns.empty() && !numbers) {
            body.columns = named(cells);
            continue;
        }
        if (body.columns.empty()) body.columns = numbered(cells.size(), lines);
        if (body.points++ == 0) body.offset = begin;
    }
    if (body.points == 0) throw InputError(file, "", "holds no point");
    return body;
}

}  // namespace

Cloud read_text_cloud(const std::filesystem::path& file) {
    std::string text = read_file(file);
    for (char& c : text) {
        if (c == ',' || c == ';') c = ' ';
    }
    const Body body = survey(text, file);
    Cloud cloud = empty_cloud(body.columns, file);
    Lines lines(text, file);
    while (lines.offset() < body.offset) lines.next();
    read_ascii(cloud, body.columns, body.points, lines);
    return cloud;
}

}  // namespace dynamic_filter::io
