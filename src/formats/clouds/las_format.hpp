// SPDX-License-Identifier: MIT
/// Constants for reading and writing LAS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::io {

constexpr std::size_t las_vlr_header_bytes = 54;
constexpr std::size_t las_extra_bytes = 192;  ///< of one entry of the Extra Bytes record
constexpr std::string_view las_spec = "LASF_Spec";
constexpr std::uint16_t las_extra_id = 4;
constexpr std::string_view las_projection = "LASF_Projection";
constexpr std::uint16_t las_wkt_id = 2112, las_geo_keys_id = 34735;
/// The key of the record of GeoTIFF keys that holds the EPSG code of a projected system.
constexpr std::uint16_t las_projected_system_key = 3072;
/// Cloud::crs of a file that names its system by GeoTIFF keys begins so.
constexpr std::string_view las_epsg = "EPSG:";

/// Bits of the header's global encoding.
constexpr std::uint16_t las_adjusted_time_bit = 1, las_wkt_bit = 16;

/// Types by their code, from 1.
constexpr std::array las_extra_types = {
    FieldType::u8,  FieldType::i8,  FieldType::u16, FieldType::i16, FieldType::u32,
    FieldType::i32, FieldType::u64, FieldType::i64, FieldType::f32, FieldType::f64};

/// Suffix of the name of an Extra Bytes field that stores the exact values of a standard field. It
/// is used where the standard field has a type that cannot represent them; the reader then uses the
/// exact values instead.
constexpr std::string_view las_exact = "_exact";

}  // namespace dynamic_filter::io
