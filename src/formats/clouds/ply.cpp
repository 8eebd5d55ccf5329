// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "base/input.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/ply_header.hpp"
#include "formats/clouds/records.hpp"

namespace dynamic_filter::io {
namespace {

using Bytes = std::vector<std::byte>;

/// Skips binary elements before the vertices, and lists among their properties.
class Walker {
public:
    Walker(std::span<const std::byte> bytes, const Lines& lines, bool big)
        : bytes_(bytes), at_(lines.offset()), file_(lines.file()), big_(big) {}

    void skip(const PlyElement& element) {
        const bool fixed = std::none_of(element.properties.begin(), element.properties.end(),
                                        [](const PlyProperty& p) { return p.list_count; });
        if (fixed) {
            std::uint64_t stride = 0;
            for (const PlyProperty& p : element.properties) stride += column_bytes(p.column);
            return advance(element.count, stride);
        }
        // Each step uses at least one byte or ends the loop.
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& p : element.properties) skip(p);
        }
    }

    void skip(const PlyProperty& p) {
        advance(p.list_count ? length(*p.list_count) : 1, column_bytes(p.column));
    }

    [[nodiscard]] std::size_t at() const { return at_; }

private:
    void advance(std::uint64_t count, std::uint64_t stride) {
        const auto bytes = product(count, stride);
        if (!bytes || *bytes > bytes_.size() - at_) {
            throw InputError(file_, fmt::format("byte {}", bytes_.size()),
                             "ends before or within its vertices; it is truncated");
        }
        at_ += *bytes;
    }

    /// Length of a list; a negative one becomes too large for any file.
    std::uint64_t length(FieldType type) {
        const std::size_t begin = at_;
        advance(1, size_of(type));
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size_of(type); ++i) {
            const std::size_t from = big_ ? begin + i : at_ - 1 - i;
            value = value << 8U | std::to_integer<std::uint64_t>(bytes_[from]);
        }
        return value;
    }

    std::span<const std::byte> bytes_;
    std::size_t at_;
    const std::filesystem::path& file_;
    bool big_;
};

/// The line of a vertex without its lists.
std::string line_without_lists(const PlyHeader& header, const Lines& lines) {
    std::string_view rest = lines.line();
    std::string plain;
    for (const PlyProperty& property : header.properties) {
        const std::string_view token = next_token(rest);
        if (!property.list_count) {
            plain += std::string(token) + " ";
            continue;
        }
        const auto length = parse_count(token);
        if (!length) {
            lines.fail(quote(token) + " is no length of the list " + quote(property.column.name));
        }
        for (std::uint64_t i = 0; i < *length && !rest.empty(); ++i) (void)next_token(rest);
    }
    return plain + std::string(rest);
}

/// The text up to the last vertex, with as many lines, but without the lists of the vertices, on
/// whose first line `lines` comes next.
std::string text_without_lists(const PlyHeader& header, Lines lines) {
    std::string text(lines.text().substr(0, lines.offset()));
    for (std::uint64_t points = 0; points < header.points && lines.next();) {
        const bool is_blank = trim(lines.line()).empty();
        if (!is_blank) ++points;
        text += (is_blank ? "" : line_without_lists(header, lines)) + "\n";
    }
    return text;
}

void skip_ascii(const PlyHeader& header, Lines& lines) {
    for (const PlyElement& element : header.before) {
        for (std::uint64_t i = 0; i < element.count && lines.next();) {
            if (!trim(lines.line()).empty()) ++i;
        }
    }
}

void read_ascii_body(Cloud& cloud, const PlyHeader& header, Lines& lines) {
    skip_ascii(header, lines);
    if (!header.has_lists) return read_ascii(cloud, header.columns, header.points, lines);
    const std::string text = text_without_lists(header, lines);
    Lines plain(text, lines.file());
    while (plain.number() < lines.number()) plain.next();
    read_ascii(cloud, header.columns, header.points, plain);
}

/// The bytes of the vertices without their lists.
Bytes without_lists(const PlyHeader& header, const Bytes& bytes, Walker& walker) {
    Bytes plain;
    for (std::uint64_t i = 0; i < header.points; ++i) {
        for (const PlyProperty& property : header.properties) {
            const std::size_t begin = walker.at();
            walker.skip(property);
            if (property.list_count) continue;
            plain.insert(plain.end(), bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                         bytes.begin() + static_cast<std::ptrdiff_t>(walker.at()));
        }
    }
    return plain;
}

void read_binary_body(Cloud& cloud, const PlyHeader& header, Bytes&& bytes, const Lines& lines) {
    Walker walker(bytes, lines, header.format == PlyFormat::big);
    for (const PlyElement& element : header.before) walker.skip(element);
    if (header.has_lists) {
        read_rows(cloud, header.columns, header.points, without_lists(header, bytes, walker), 0);
        if (header.format == PlyFormat::big) swap_bytes(cloud);
        return;
    }
    const std::size_t stride = record_bytes(header.columns);
    const std::size_t present = (bytes.size() - walker.at()) / stride;
    if (header.points > present) {
        throw InputError(lines.file(), fmt::format("byte {}", bytes.size()),
                         fmt::format("ends after {} of {} points of {} bytes; it is truncated",
                                     present, header.points, stride));
    }
    read_rows(cloud, header.columns, header.points, std::move(bytes), walker.at());
    if (header.format == PlyFormat::big) swap_bytes(cloud);
}

}  // namespace

Cloud read_ply(const std::filesystem::path& file) {
    Bytes bytes = read_bytes(file);
    Lines lines(as_text(bytes), file);
    const PlyHeader header = parse_ply_header(lines);
    Cloud cloud = empty_cloud(header.columns, file);
    if (header.format == PlyFormat::ascii) {
        read_ascii_body(cloud, header, lines);
    } else {
        read_binary_body(cloud, header, std::move(bytes), lines);
    }
    return with_real_coordinates(std::move(cloud));
}

}  // namespace dynamic_filter::io
