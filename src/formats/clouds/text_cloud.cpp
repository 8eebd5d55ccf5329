// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "base/text.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/clouds/field_types.hpp"
#include "formats/clouds/records.hpp"
#include "formats/clouds/text_cloud.hpp"

namespace dynamic_filter::io {
namespace {

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with("//"); }

/// A title as the name of a field: "X" is x, and so is "Points:0" of VeloView.
std::string name_of_title(std::string_view title) {
    std::string name = to_lower(title);
    std::erase(name, '"');
    const bool is_axis = name.starts_with("points") && name.size() > 2 &&
                         name[name.size() - 2] == ':' && name.back() >= '0' && name.back() <= '2';
    if (is_axis) return std::string(1, "xyz"[name.back() - '0']);
    for (char& c : name) {
        if (c <= ' ' || c > '~') c = '_';
    }
    return name;
}

bool is_separator(char c) { return c == ',' || c == ';'; }

/// The fields that a line names; empty if it begins with a number.
std::vector<Column> named(std::string_view line) {
    const auto mark = std::find_if(line.begin(), line.end(), is_separator);
    auto titles = mark == line.end() ? split_tokens(line) : split_at(line, *mark);
    if (!titles.empty() && titles.back().empty()) titles.pop_back();
    std::vector<Column> columns;
    if (titles.empty() || parse_real(titles.front())) return columns;
    for (const std::string_view title : titles)
        columns.push_back({name_of_title(title), FieldType::f64});
    return columns;
}

/// The first line that is no comment and not blank; `lines` is then at it.
std::string_view first_line(Lines& lines) {
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        if (!line.empty() && !is_comment(line)) return line;
    }
    return {};
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

/// Reads the text once to find the columns, if no titles name them, and the number of points.
Body survey(std::string_view text, const std::filesystem::path& file, std::vector<Column> titles) {
    Body body{.columns = std::move(titles)};
    bool is_behind_titles = body.columns.empty();
    Lines lines(text, file);
    for (std::size_t begin = 0; lines.next(); begin = lines.offset()) {
        const std::string_view line = trim(lines.line());
        if (line.empty() || (body.points == 0 && is_comment(line))) continue;
        if (!is_behind_titles) {
            is_behind_titles = true;
            continue;
        }
        if (body.columns.empty()) body.columns = numbered(split_tokens(line).size(), lines);
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

bool names_points(std::string_view head) {
    Lines lines(head, "");
    const std::vector<Column> columns = named(first_line(lines));
    const auto has = [&](const char* name) {
        return std::any_of(columns.begin(), columns.end(),
                           [&](const Column& column) { return column.name == name; });
    };
    // Poses have positions as well.
    return has("x") && has("y") && has("z") && !has("qx") && !has("qw");
}

Cloud read_text_cloud(const std::filesystem::path& file) {
    std::string text = read_file(file);
    refuse_mixed_separators(text, file);
    Lines begin(text, file);
    std::vector<Column> titles = named(first_line(begin));
    std::replace_if(text.begin(), text.end(), is_separator, ' ');
    const Body body = survey(text, file, std::move(titles));
    Cloud cloud = empty_cloud(body.columns, file);
    Lines lines(text, file);
    while (lines.offset() < body.offset) lines.next();
    read_ascii(cloud, body.columns, body.points, lines);
    return cloud;
}

}  // namespace dynamic_filter::io
