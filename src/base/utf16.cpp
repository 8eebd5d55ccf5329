// SPDX-License-Identifier: MIT
#include "base/utf16.hpp"

#include <cstddef>

namespace dynamic_filter::io {

std::string decoded(std::string text) {
    const bool is_little = text.starts_with("\xFF\xFE");
    if (!is_little && !text.starts_with("\xFE\xFF")) return text;
    std::string plain;
    plain.reserve(text.size() / 2);
    for (std::size_t at = 2; at + 1 < text.size(); at += 2) {
        const char low = text[is_little ? at : at + 1], high = text[is_little ? at + 1 : at];
        const bool is_ascii = high == 0 && static_cast<unsigned char>(low) < 128;
        plain += is_ascii ? low : '?';
    }
    return plain;
}

}  // namespace dynamic_filter::io
