// SPDX-License-Identifier: MIT
#include "check/advice.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace dynamic_filter::app {
namespace {

/// True if the second correction takes the first one back.
bool undoes(const std::string& first, const std::string& second) {
    constexpr std::array<std::array<const char*, 2>, 6> kOpposites{{{"inverse", "inverse"},
                                                                    {"camera", "lidar"},
                                                                    {"wxyz", "xyzw"},
                                                                    {"transpose", "transpose"},
                                                                    {"mirror", "mirror"},
                                                                    {"ned", "ned"}}};
    for (const auto& [a, b] : kOpposites) {
        if ((first == a && second == b) || (first == b && second == a)) return true;
    }
    return false;
}

std::string quoted(const std::string& word) {
    return word.find(' ') == std::string::npos ? word : "'" + word + "'";
}

std::string typed(const std::string& name, const std::string& value) {
    return name + " " + quoted(value);
}

std::string typed(const std::string& name, const std::optional<std::filesystem::path>& value) {
    return value ? typed(name, value->string()) : "";
}

std::string typed(const std::string& name, bool value) { return value ? name : ""; }

/// Numbers select scans, but the run is over all of them.
template <class T>
std::string typed(const std::string&, const T&) {
    return "";
}

bool set(std::string& member, const std::string& value) {
    member = value;
    return true;
}
bool set(std::optional<std::filesystem::path>& member, const std::string& value) {
    member = value;
    return true;
}
bool set(bool& member, const std::string&) { return member = true; }
template <class T>
bool set(T&, const std::string&) {
    return false;
}

/// Each option, and what was typed for it.
std::vector<std::pair<std::string, std::string>> typed(const DataOptions& given) {
    std::vector<std::pair<std::string, std::string>> words;
    visit_reading(given, [&](const ReadingOption& option, const auto& value) {
        words.emplace_back(as_option(option), typed(as_option(option), value));
    });
    return words;
}

}  // namespace

io::Finding blame_needless_fix(io::Finding finding, const DataOptions& given) {
    const std::string option = "--pose-fix ";
    if (!finding.advice.starts_with(option)) return finding;
    if (!undoes(given.pose_fix, finding.advice.substr(option.size()))) return finding;
    const std::size_t reason = finding.what.find(": ");
    return {"the poses are right without " + option + given.pose_fix +
                (reason == std::string::npos ? "" : finding.what.substr(reason)),
            "leave out --pose-fix"};
}

std::string warning_of(const io::Finding& finding, const DataOptions& given) {
    const auto [what, advice] = blame_needless_fix(finding, given);
    return fmt::format("{}; {}{} (`dynamicfilter check` looks closer)", what,
                       advice.starts_with("--") ? "try " : "", advice);
}

std::string next_command(const DataOptions& given, const std::string& option) {
    return next_command({given.data}, given, option);
}

std::string next_command(const std::vector<std::filesystem::path>& recordings,
                         const DataOptions& given, const std::string& option) {
    std::string line = "dynamicfilter run";
    for (const auto& recording : recordings) line += " " + quoted(recording.string());
    const auto usual = typed(DataOptions{}), words = typed(given);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto& [name, word] = words[i];
        if (word != usual[i].second && !option.starts_with(name)) line += " " + word;
    }
    return option.empty() ? line : line + " " + option;
}

std::optional<DataOptions> with_option(DataOptions given, const std::string& option) {
    const std::size_t blank = option.find(' ');
    const std::string name = option.substr(0, blank);
    const std::string value = blank == std::string::npos ? "" : option.substr(blank + 1);
    bool is_set = false;
    visit_reading(given, [&](const ReadingOption& row, auto& member) {
        if (as_option(row) == name) is_set = set(member, value);
    });
    return is_set ? std::optional(std::move(given)) : std::nullopt;
}

}  // namespace dynamic_filter::app
