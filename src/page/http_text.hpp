// SPDX-License-Identifier: MIT
/// What the readers of HTTP requests share. The texts may hold any bytes.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace dynamic_filter::app {

/// Up to the separator, which is taken away, too.
inline std::string_view pop_until(std::string_view& text, std::string_view separator) {
    const std::size_t at = std::min(text.find(separator), text.size());
    const std::string_view taken = text.substr(0, at);
    text.remove_prefix(std::min(at + separator.size(), text.size()));
    return taken;
}

/// Without blanks and tabs around it.
inline std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

inline std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

}  // namespace dynamic_filter::app
