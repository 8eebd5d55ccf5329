// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstring>

#include "base/input.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/lzf.hpp"
#include "formats/clouds/pcd_header.hpp"
#include "formats/clouds/records.hpp"

namespace dynamic_filter::io {
namespace {

using Bytes = std::vector<std::byte>;

void read_ascii_body(Cloud& cloud, const PcdHeader& header, Lines& lines) {
    read_ascii(cloud, header.columns, header.points, lines);
    while (lines.next()) {
        if (!trim(lines.line()).empty()) {
            lines.fail("more points than the " + std::to_string(header.points) +
                       " the header promises");
        }
    }
}

void read_binary_body(Cloud& cloud, const PcdHeader& header, Bytes&& bytes, const Lines& lines) {
    const std::size_t stride = record_bytes(header.columns);
    const std::size_t present = (bytes.size() - lines.offset()) / stride;
    if (header.points > present) {
        throw InputError(lines.file(), fmt::format("byte {}", bytes.size()),
                         fmt::format("ends after {} of {} points of {} bytes; it is truncated",
                                     present, header.points, stride));
    }
    read_rows(cloud, header.columns, header.points, std::move(bytes), lines.offset());
}

/// The two sizes before a compressed body, and the body.
struct Compressed {
    std::size_t expanded = 0;
    std::span<const std::byte> stream;
};

Compressed find_stream(const Bytes& bytes, const Lines& lines) {
    const std::span<const std::byte> body = std::span(bytes).subspan(lines.offset());
    std::uint32_t sizes[2] = {};
    const auto truncated = [&](std::size_t needed) {
        return InputError(lines.file(), fmt::format("byte {}", bytes.size()),
                          fmt::format("the compressed body has {} of {} bytes; it is truncated",
                                      body.size(), needed));
    };
    if (body.size() < sizeof sizes) throw truncated(sizeof sizes);
    std::memcpy(sizes, body.data(), sizeof sizes);
    if (body.size() - sizeof sizes < sizes[0]) throw truncated(sizeof sizes + sizes[0]);
    return {sizes[1], body.subspan(sizeof sizes, sizes[0])};
}

void read_compressed_body(Cloud& cloud, const PcdHeader& header, const Bytes& bytes,
                          const Lines& lines) {
    const Compressed packed = find_stream(bytes, lines);
    const std::string where = fmt::format("byte {}", lines.offset());
    // Programs handle padding differently: PCL leaves it out of the compressed body, others include
    // it.
    std::vector<Column> columns = header.columns;
    const auto lean = product(header.points, cloud.point_bytes);
    if (lean == packed.expanded) {
        std::erase_if(columns, [](const Column& column) { return column.padding; });
    } else if (product(header.points, record_bytes(columns)) != packed.expanded) {
        throw InputError(lines.file(), where,
                         fmt::format("the compressed body declares {} bytes, the header {} points "
                                     "of {} bytes",
                                     packed.expanded, header.points, record_bytes(columns)));
    }
    const auto block = lzf_expand(packed.stream, packed.expanded);
    if (!block) {
        throw InputError(lines.file(), where,
                         fmt::format("the compressed body is damaged: its {} bytes do not expand "
                                     "to the {} declared",
                                     packed.stream.size(), packed.expanded));
    }
    read_columns(cloud, columns, header.points, *block);
}

}  // namespace

Cloud read_pcd(const std::filesystem::path& file) {
    Bytes bytes = read_bytes(file);
    Lines lines(as_text(bytes), file);
    const PcdHeader header = parse_pcd_header(lines);
    Cloud cloud = empty_cloud(header.columns, file);
    cloud.viewpoint = header.viewpoint;
    switch (header.data) {
        case PcdData::ascii:
            read_ascii_body(cloud, header, lines);
            break;
        case PcdData::binary:
            read_binary_body(cloud, header, std::move(bytes), lines);
            break;
        case PcdData::compressed:
            read_compressed_body(cloud, header, bytes, lines);
            break;
    }
    return with_real_coordinates(std::move(cloud));
}

}  // namespace dynamic_filter::io
