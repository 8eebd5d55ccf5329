// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// Number of a label in the viewer's arrays: 0 unknown, 1 static, 2 dynamic.
inline std::uint8_t verdict_code(Label label) {
    return label == Label::dynamic ? 2 : label == Label::static_ ? 1 : 0;
}

/// The label of a code of verdict_code(), of which only the last two bits count.
inline Label label_of_code(unsigned code) {
    constexpr std::array<Label, 4> kLabels = {Label::unknown, Label::static_, Label::dynamic,
                                              Label::unknown};
    return kLabels[code & 3U];
}

}  // namespace dynamic_filter::app
