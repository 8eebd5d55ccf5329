// SPDX-License-Identifier: MIT
/// What a command says to whoever started it.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

namespace dynamic_filter::app {

/// A reader that goes away (`| head`) stops nothing: what is said to it is lost. Throws OutputError
/// if the text cannot be written for another reason, such as a full disk.
void say_text(std::FILE* to, std::string_view text);
/// Writes what is still held back of the standard output; the same errors.
void finish_saying();

template <class... Values>
void say(std::FILE* to, fmt::format_string<Values...> format, Values&&... values) {
    say_text(to, fmt::format(format, std::forward<Values>(values)...));
}
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
    say_text(stdout, fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace dynamic_filter::app
