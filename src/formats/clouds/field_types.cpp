// SPDX-License-Identifier: MIT
#include "formats/clouds/field_types.hpp"

namespace dynamic_filter::io {

std::vector<Field> single_fields(const Cloud& cloud) {
    std::vector<Field> singles;
    for (const Field& field : cloud.fields) {
        for (std::uint32_t i = 0; i < field.count; ++i) {
            const std::string suffix = field.count == 1 ? "" : "_" + std::to_string(i);
            const auto step = static_cast<std::uint32_t>(size_of(field.type));
            singles.push_back({field.name + suffix, field.type, 1, field.offset + i * step});
        }
    }
    return singles;
}

}  // namespace dynamic_filter::io
