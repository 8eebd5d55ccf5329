// SPDX-License-Identifier: MIT
/// One function per reader: takes any bytes, gives a result or an Error, never anything else.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace dynamic_filter::fuzz {

using Target = void (*)(std::span<const std::uint8_t> bytes);

const std::map<std::string, Target>& targets();

}  // namespace dynamic_filter::fuzz
