// SPDX-License-Identifier: MIT
#include <algorithm>
#include <regex>
#include <string>

#include "python/src/module.hpp"

namespace dynamic_filter::python {

namespace {

/// `--stride` and `--pose-fix` become `stride` and `pose_fix`.
std::string without_dashes(const std::string& text) {
    static const std::regex name("--([a-z]+(-[a-z]+)*)");
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

std::string with_keywords(std::string text) {
    // Settings; switches; options with a value that stands behind them; and options that are only
    // named.
    static const std::regex number_set(R"(--set ([a-z_.]+)=(-?[0-9][0-9.]*)\b)");
    static const std::regex set(R"(--set ([a-z_.]+)=(\w+))");
    static const std::regex flag("--(overwrite|resume|online|points-in-world|quiet)\\b");
    static const std::regex number("--(first|last|stride|voxel|min-range|max-range) (\\d+)\\b");
    static const std::regex placeholder("--([a-z-]+[a-z]) ([A-Z]+)\\b");
    static const std::regex word(
        "--([a-z-]+[a-z]) (none|inverse|camera|lidar|wxyz|xyzw|mm|s|ms|us|ns|kitti|benchmark|"
        "folder|bag|on|off|auto|/[\\w/]+)(?=$|[^\\w-])");
    static const std::regex folder("(^|[^\\w-])-o DIR\\b"), output("(^|[^\\w-])-o\\b");
    text = std::regex_replace(text, number_set, "config={\"$1\": $2}");
    text = std::regex_replace(text, set, "config={\"$1\": \"$2\"}");
    text = std::regex_replace(text, flag, "--$1=True");
    text = std::regex_replace(text, number, "--$1=$2");
    text = std::regex_replace(text, placeholder, "--$1=$2");
    text = std::regex_replace(text, word, "--$1=\"$2\"");
    text = std::regex_replace(text, folder, "$1output=DIR");
    text = std::regex_replace(text, output, "$1output");
    return without_dashes(text);
}

}  // namespace

std::string in_python(const std::string& message) {
    static const std::regex command("`dynamicfilter [^`]*`");  // stays as it is typed
    std::string result;
    auto rest = message.cbegin();
    for (std::sregex_iterator it(message.begin(), message.end(), command), end; it != end; ++it) {
        result += with_keywords({rest, (*it)[0].first}) + it->str();
        rest = (*it)[0].second;
    }
    return result + with_keywords({rest, message.cend()});
}

}  // namespace dynamic_filter::python
