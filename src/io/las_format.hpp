// SPDX-License-Identifier: MIT
/// What reading and writing LAS share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dynamic_filter/io/cloud.hpp"

namespace dynamic_filter::io {

constexpr std::size_t las_vlr_header_bytes = 54;
constexpr std::size_t las_extra_bytes = 192;  ///< of one entry of the Extra Bytes record
constexpr std::string_view las_spec = "LASF_Spec";
constexpr std::uint16_t las_extra_id = 4;

/// By code, from 1.
constexpr std::array las_extra_types = {
    FieldType::u8,  FieldType::i8,  FieldType::u16, FieldType::i16, FieldType::u32,
    FieldType::i32, FieldType::u64, FieldType::i64, FieldType::f32, FieldType::f64};

/// Behind the name of a standard field, an Extra Bytes field that holds what the standard one,
/// being of another type, could not; the reader puts it in the other's place.
constexpr std::string_view las_exact = "_exact";

}  // namespace dynamic_filter::io
