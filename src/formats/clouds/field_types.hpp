// SPDX-License-Identifier: MIT
/// Dispatch from the type of a field, known at run time, to a C++ type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "formats/byte_reader.hpp"

namespace dynamic_filter::io {

/// Calls `f` with std::type_identity of the C++ type.
template <class F>
decltype(auto) with_type(FieldType type, F&& f) {
    switch (type) {
        case FieldType::i8:
            return f(std::type_identity<std::int8_t>{});
        case FieldType::u8:
            return f(std::type_identity<std::uint8_t>{});
        case FieldType::i16:
            return f(std::type_identity<std::int16_t>{});
        case FieldType::u16:
            return f(std::type_identity<std::uint16_t>{});
        case FieldType::i32:
            return f(std::type_identity<std::int32_t>{});
        case FieldType::u32:
            return f(std::type_identity<std::uint32_t>{});
        case FieldType::i64:
            return f(std::type_identity<std::int64_t>{});
        case FieldType::u64:
            return f(std::type_identity<std::uint64_t>{});
        case FieldType::f32:
            return f(std::type_identity<float>{});
        case FieldType::f64:
            break;
    }
    return f(std::type_identity<double>{});
}

template <class T>
void store_at(std::byte* bytes, T value) {
    std::memcpy(bytes, &value, sizeof value);
}

/// The fields of the cloud with one value each: a field "n" of two values becomes "n_0" and "n_1".
std::vector<Field> single_fields(const Cloud& cloud);

}  // namespace dynamic_filter::io
