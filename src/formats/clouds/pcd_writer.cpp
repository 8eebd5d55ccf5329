// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iterator>
#include <limits>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/clouds/field_types.hpp"
#include "formats/clouds/lzf.hpp"
#include "formats/clouds/pcd_header.hpp"

namespace dynamic_filter::io {
namespace {

void append_value(fmt::memory_buffer& text, FieldType type, const std::byte* bytes) {
    with_type(type, [&]<class T>(std::type_identity<T>) {
        // "{}" prints the fewest digits that are read back as the same number.
        if constexpr (sizeof(T) == 1) {
            fmt::format_to(std::back_inserter(text), "{} ",
                           static_cast<int>(little_endian<T>(bytes)));
        } else {
            fmt::format_to(std::back_inserter(text), "{} ", little_endian<T>(bytes));
        }
    });
}

void write_ascii(AtomicFile& file, const Cloud& cloud) {
    const std::vector<Field> fields = single_fields(cloud);
    fmt::memory_buffer line;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const std::byte* record = cloud.data.data() + i * cloud.point_bytes;
        line.clear();
        for (const Field& field : fields) append_value(line, field.type, record + field.offset);
        line.data()[line.size() - 1] = '\n';
        file.write(std::string_view(line.data(), line.size()));
    }
}

/// The first field of all points, then the second field of all points, and so on.
std::vector<std::byte> by_field(const Cloud& cloud) {
    std::vector<std::byte> block;
    block.reserve(cloud.data.size());
    for (const Field& field : cloud.fields) {
        const auto bytes = static_cast<std::ptrdiff_t>(size_of(field.type) * field.count);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            const std::byte* value = cloud.data.data() + i * cloud.point_bytes + field.offset;
            block.insert(block.end(), value, value + bytes);
        }
    }
    return block;
}

void write_compressed(AtomicFile& file, const Cloud& cloud, const std::filesystem::path& path) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    const auto refuse = [&](std::size_t bytes) {
        if (bytes <= most) return;
        throw OutputError(path, fmt::format("{} bytes; a compressed PCD holds less than 4 GiB, "
                                            "write it uncompressed",
                                            bytes));
    };
    refuse(cloud.data.size());
    const std::vector<std::byte> packed = lzf_pack(by_field(cloud));
    refuse(packed.size());
    const std::uint32_t sizes[] = {static_cast<std::uint32_t>(packed.size()),
                                   static_cast<std::uint32_t>(cloud.data.size())};
    file.write(std::as_bytes(std::span(sizes)));
    file.write(packed);
}

}  // namespace

void write_pcd(const std::filesystem::path& path, const Cloud& cloud, PcdData data) {
    AtomicFile file(path);
    const Pose viewpoint = cloud.viewpoint.value_or(Pose::Identity());
    file.write(pcd_header_text(cloud.fields, cloud.size(), viewpoint, data).text);
    switch (data) {
        case PcdData::ascii:
            write_ascii(file, cloud);
            break;
        case PcdData::binary:
            file.write(cloud.data);
            break;
        case PcdData::compressed:
            write_compressed(file, cloud, path);
            break;
    }
    file.commit();
}

}  // namespace dynamic_filter::io
