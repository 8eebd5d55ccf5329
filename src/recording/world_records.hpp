// SPDX-License-Identifier: MIT
/// The points of a scan as records in the world, with all their fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// The scan's fields; float coordinates become double where the world's origin is so far away that
/// a float would be off by a millimetre or more. `in_world`: as they are.
io::Cloud layout_of(const io::FullScan& scan, bool in_world);

/// Throws ConfigError if the scan has other fields than the layout, as those of another sensor may.
void refuse_other_fields(const io::FullScan& scan, const io::Cloud& layout);

/// The scan's records in the given layout (same fields, x y z perhaps wider), x y z in the world.
std::vector<std::byte> world_records(const io::FullScan& scan, const io::Cloud& layout);
/// The records of these of its points.
std::vector<std::byte> world_records(const io::FullScan& scan, const io::Cloud& layout,
                                     std::span<const std::uint32_t> points);

/// Adds record i of `records`, each of which has so many bytes.
void append_record(std::vector<std::byte>& to, std::span<const std::byte> records, std::size_t i,
                   std::size_t bytes);

}  // namespace dynamic_filter::app
