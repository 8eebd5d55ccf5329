// SPDX-License-Identifier: MIT
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>
#include <string>

#include "python/src/module.hpp"
#include "recording/layouts/registry.hpp"

namespace dynamic_filter::python {

std::string in_python(const std::string& message) {
    // Switches; options with a value that stands behind them; and options that are only named.
    static const std::regex flag("--(overwrite|resume|online|points-in-world|quiet)\\b");
    static const std::regex number("--(first|last|stride|voxel|min-range|max-range) (\\d+)\\b");
    static const std::regex placeholder("--([a-z-]+[a-z]) ([A-Z]+)\\b");
    static const std::regex word(
        "--([a-z-]+[a-z]) (none|inverse|camera|lidar|wxyz|xyzw|mm|s|ms|"
        "us|ns|" +
        fmt::format("{}", fmt::join(io::layout_names(), "|")) +
        "|on|off|auto|/[\\w/]+)(?=$|[^\\w-])");
    static const std::regex name("--([a-z]+(-[a-z]+)*)");
    std::string text = std::regex_replace(message, flag, "--$1=True");
    text = std::regex_replace(text, number, "--$1=$2");
    text = std::regex_replace(text, placeholder, "--$1=$2");
    text = std::regex_replace(text, word, "--$1=\"$2\"");
    std::string result;
    auto rest = text.cbegin();
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it) {
        result.append(rest, (*it)[0].first);
        std::string option = (*it)[1];
        std::replace(option.begin(), option.end(), '-', '_');
        result += option;
        rest = (*it)[0].second;
    }
    return result.append(rest, text.cend());
}

}  // namespace dynamic_filter::python
