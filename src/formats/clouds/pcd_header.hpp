// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "dynamic_filter/cloud.hpp"
#include "formats/clouds/records.hpp"

namespace dynamic_filter::io {

struct PcdHeader {
    std::vector<Column> columns;
    std::uint64_t points = 0;
    std::optional<Pose> viewpoint;  ///< empty if absent or the identity
    PcdData data = PcdData::ascii;
};

/// Reads the header; `lines` is then behind the DATA line. Throws InputError.
PcdHeader parse_pcd_header(Lines& lines);

/// Text of a header, and the positions of its counts. The counts are padded, so that any count
/// fits.
struct PcdHeaderText {
    std::string text;
    std::size_t width_at = 0, points_at = 0;
};
constexpr std::size_t pcd_count_width = 20;

/// The header of a PCD file whose fields have no padding.
PcdHeaderText pcd_header_text(const std::vector<Field>& fields, std::size_t points,
                              const Pose& viewpoint, PcdData data = PcdData::binary);

/// A count, padded to the width that it has in the header.
std::string pcd_count(std::size_t count);

}  // namespace dynamic_filter::io
