// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// Of a verdict or of the truth, as the viewer counts: 0 unknown, 1 static, 2 dynamic.
inline std::uint8_t verdict_code(Label label) {
    return label == Label::dynamic ? 2 : label == Label::static_ ? 1 : 0;
}

}  // namespace dynamic_filter::app
