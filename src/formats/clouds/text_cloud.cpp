// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <iterator>

#include "base/text.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/clouds/field_types.hpp"
#include "formats/clouds/records.hpp"

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
    std::size_t offset = 0;    ///< [bytes] offset of the line of the first point
    std::uint64_t points = 0;  ///< number of lines with points
};

/// Reads the text once to find the names of the columns and the number of points.
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

/// Throws if lines contain commas and semicolons: 1,5 would be read as two numbers.
void refuse_mixed_separators(std::string_view text, const std::filesystem::path& file) {
    for (Lines lines(text, file); lines.next();) {
        const std::string_view line = trim(lines.line());
        const bool both = line.find(';') != line.npos && line.find(',') != line.npos;
        if (!both || is_comment(line)) continue;
        lines.fail("has semicolons and commas: decimal commas? write decimal points, as in 1.5");
    }
}

/// The shortest text that is read back as the same number.
template <class T>
void append_number(std::string& text, T value) {
    if constexpr (sizeof(T) == 1) {
        fmt::format_to(std::back_inserter(text), "{}", static_cast<int>(value));
    } else {
        fmt::format_to(std::back_inserter(text), "{}", value);
    }
}

}  // namespace

std::string write_text_cloud(const std::filesystem::path& path, const Cloud& cloud) {
    const std::vector<Field> fields = single_fields(cloud);
    const char separator = to_lower(path.extension().string()) == ".csv" ? ',' : ' ';
    std::string text;
    for (const Field& field : fields)
        text += (text.empty() ? "" : std::string(1, separator)) + field.name;
    AtomicFile file(path);
    file.write(text + "\n");
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const std::byte* const record = cloud.data.data() + i * cloud.point_bytes;
        text.clear();
        for (const Field& field : fields) {
            if (!text.empty()) text += separator;
            with_type(field.type, [&](auto type) {
                append_number(text,
                              little_endian<typename decltype(type)::type>(record + field.offset));
            });
        }
        file.write(text + "\n");
    }
    file.commit();
    return "";
}

Cloud read_text_cloud(const std::filesystem::path& file) {
    std::string text = read_file(file);
    refuse_mixed_separators(text, file);
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
