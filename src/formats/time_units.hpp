// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace dynamic_filter::io {

constexpr std::int64_t kSecond = 1'000'000'000;  ///< [ns]

}  // namespace dynamic_filter::io
