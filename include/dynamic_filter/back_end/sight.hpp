// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace dynamic_filter {

/// What a scan says about a place.
enum class Sight : std::uint8_t { nothing, occupied, passed };

}  // namespace dynamic_filter
