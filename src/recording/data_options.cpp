// SPDX-License-Identifier: MIT
#include "recording/data_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

namespace {

/// Empty if the value is possible, otherwise what is wrong with it.
std::string fault_of(const ReadingOption& option, const std::string& value) {
    if (option.is_place && !value.empty() && !place_of(value)) {
        return fmt::format("'{}' is no place; expected X,Y,Z in metres, such as 0.9,0,1.6", value);
    }
    const auto& choices = option.choices;
    const bool is_free = choices.empty() || value.empty();
    if (is_free || std::find(choices.begin(), choices.end(), value) != choices.end()) return "";
    return fmt::format("'{}' is none of {}", value, fmt::join(choices, ", "));
}

std::string fault_of(const ReadingOption& option, std::size_t value) {
    if (value >= option.low) return "";
    return fmt::format("{} is no whole number of {} or more", value, option.low);
}

/// Paths, switches and numbers that are not given have no wrong values.
template <class T>
std::string fault_of(const ReadingOption&, const T&) {
    return "";
}

}  // namespace

std::vector<std::string> pose_fix_names() {
    std::vector<std::string> names{"none"};
    for (const io::PoseFix fix : io::pose_fixes()) names.push_back(io::to_string(fix));
    return names;
}

std::optional<Eigen::Vector3d> place_of(const std::string& text) {
    const std::vector<double> numbers = io::parse_reals(text);
    if (numbers.size() != 3) return std::nullopt;
    return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

std::string as_option(const char* name) {
    std::string option = std::string("--") + name;
    std::replace(option.begin(), option.end(), '_', '-');
    return option;
}

void refuse_invalid(const DataOptions& options, Asker asker) {
    visit_reading(options, [&](const ReadingOption& option, const auto& value) {
        const std::string fault = fault_of(option, value);
        if (fault.empty()) return;
        throw ConfigError((asker == Asker::python ? option.name : as_option(option)) + ": " +
                          fault);
    });
}

}  // namespace dynamic_filter::app
