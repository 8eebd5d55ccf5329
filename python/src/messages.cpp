// SPDX-License-Identifier: MIT
#include <algorithm>
#include <regex>
#include <string>

#include "python/src/module.hpp"

namespace dynamic_filter::python {

namespace {

/// Alternatives of regular expressions, with "|" before each: the reading options of each kind, and
/// all their choices.
struct Spellings {
    std::string switches, numbers, choices;
};

void add(Spellings& known, const app::ReadingOption& option, const std::string&) {
    for (const std::string& choice : option.choices) known.choices += "|" + choice;
}
void add(Spellings& known, const app::ReadingOption& option, bool) {
    known.switches += "|" + app::as_option(option).substr(2);
}
void add(Spellings&, const app::ReadingOption&, const std::optional<std::filesystem::path>&) {}
template <class Whole>
void add(Spellings& known, const app::ReadingOption& option, const Whole&) {
    known.numbers += "|" + app::as_option(option).substr(2);
}

Spellings spellings() {
    const app::DataOptions standard;
    Spellings known;
    app::visit_reading(standard, [&](const app::ReadingOption& option, const auto& value) {
        add(known, option, value);
    });
    return known;
}

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
    static const Spellings known = spellings();
    static const std::regex flag("--(overwrite|resume|online|quiet" + known.switches + ")\\b");
    static const std::regex number("--(voxel|min-range|max-range" + known.numbers + ") (\\d+)\\b");
    static const std::regex placeholder("--([a-z-]+[a-z]) ([A-Z]+)\\b");
    static const std::regex word("--([a-z-]+[a-z]) (/[\\w/]+" + known.choices + ")(?=$|[^\\w-])");
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
