// SPDX-License-Identifier: MIT
#include "formats/clouds/field_types.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace field_types_test {

TEST(FieldTypes, EachHasItsOwnCppType) {
    constexpr FieldType kTypes[] = {FieldType::i8,  FieldType::u8,  FieldType::i16, FieldType::u16,
                                    FieldType::i32, FieldType::u32, FieldType::i64, FieldType::u64,
                                    FieldType::f32, FieldType::f64};
    std::size_t floating = 0, is_signed = 0;
    for (const FieldType type : kTypes) {
        with_type(type, [&]<class T>(std::type_identity<T>) {
            EXPECT_EQ(sizeof(T), size_of(type));
            floating += std::is_floating_point_v<T> ? 1 : 0;
            is_signed += std::is_signed_v<T> ? 1 : 0;
        });
    }
    EXPECT_EQ(floating, 2U);
    EXPECT_EQ(is_signed, 6U);
}

TEST(FieldTypes, AFieldOfSeveralValuesBecomesAsManyFields) {
    Cloud cloud;
    add_field(cloud, "x", FieldType::f32);
    add_field(cloud, "normal", FieldType::i16, 3);
    add_field(cloud, "ring", FieldType::u8);
    const std::vector<Field> expected{{"x", FieldType::f32, 1, 0},
                                      {"normal_0", FieldType::i16, 1, 4},
                                      {"normal_1", FieldType::i16, 1, 6},
                                      {"normal_2", FieldType::i16, 1, 8},
                                      {"ring", FieldType::u8, 1, 10}};
    EXPECT_EQ(single_fields(cloud), expected);
}

}  // namespace field_types_test
}  // namespace dynamic_filter::io
