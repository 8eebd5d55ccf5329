// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "formats/clouds/records.hpp"

namespace dynamic_filter::io {

enum class PlyFormat : std::uint8_t { ascii, little, big };

struct PlyProperty {
    Column column;                        ///< of a list: type of its entries
    std::optional<FieldType> list_count;  ///< set for a list: type of its length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> before;  ///< elements before the vertices
    std::uint64_t points = 0;
    std::vector<Column> columns;          ///< columns of the vertices, without lists
    std::vector<PlyProperty> properties;  ///< the same and the lists between them
    bool has_lists = false;
};

/// Reads the header; `lines` is then behind the end_header line. Throws InputError.
PlyHeader parse_ply_header(Lines& lines);

}  // namespace dynamic_filter::io
