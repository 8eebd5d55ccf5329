// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dynamic_filter::io {

/// Natural order of names: "a2" is before "a10".
bool natural_less(const std::string& a, const std::string& b);

}  // namespace dynamic_filter::io
