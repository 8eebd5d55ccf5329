// SPDX-License-Identifier: MIT
/// Reads numbers from the arguments of the measuring programs.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <type_traits>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter {

/// Throws ConfigError if the text is no such number; `what` names the argument.
template <class Number>
Number parse(std::string_view what, std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) {
        throw ConfigError(fmt::format("{} is \"{}\": expected {}", what, text,
                                      std::is_integral_v<Number> ? "an integer" : "a number"));
    }
    return number;
}

}  // namespace dynamic_filter
