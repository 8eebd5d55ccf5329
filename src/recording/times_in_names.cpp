// SPDX-License-Identifier: MIT
#include "recording/times_in_names.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "base/natural_order.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double least_time = 1e8;  // smaller whole numbers are indices, not times
// [s] between scans. A factor of less than 1,000 lies between both, so one unit fits at most.
constexpr double shortest_step = 0.02, longest_step = 19.0;
constexpr std::array<double, 4> units = {1.0, 1e-3, 1e-6, 1e-9};

/// The end of a name: "cloud_" and "1700000000" and "2", or "cloud_1700000000_" and "200000000".
struct NumberInName {
    std::string_view before, whole, fraction;
};

std::string_view trailing_digits(std::string_view text) {
    const std::size_t other = text.find_last_not_of("0123456789");
    return other == std::string_view::npos ? text : text.substr(other + 1);
}

NumberInName number_at_end(std::string_view name) {
    NumberInName number{.before = name, .whole = trailing_digits(name), .fraction = {}};
    number.before.remove_suffix(number.whole.size());
    if (!number.before.ends_with('.')) return number;
    const std::string_view whole =
        trailing_digits(number.before.substr(0, number.before.size() - 1));
    if (whole.empty()) return number;
    return {.before = name.substr(0, number.before.size() - 1 - whole.size()),
            .whole = whole,
            .fraction = number.whole};
}

double value_of(std::string_view digits) { return parse_real(digits).value_or(0.0); }

double median_step(const std::vector<double>& times) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < times.size(); ++i)
        steps.push_back(std::abs(times[i] - times[i - 1]));
    return median(std::move(steps));
}

bool is_step_between_scans(double seconds) {
    return seconds >= shortest_step && seconds <= longest_step;
}

/// The unit of whole numbers that are times: a date, or the uptime of a sensor. One unit at most
/// makes a date of a number, and one at most a usual step of a difference. The date counts first,
/// because scans may be minutes apart; `check` names steps that are too long.
std::optional<double> unit_of(const std::vector<double>& numbers) {
    constexpr double first_date = 1e8, last_date = 1e10;  // [s] since 1970: 1973 to 2286
    const double size = numbers[numbers.size() / 2], step = median_step(numbers);
    std::optional<double> by_date, by_step;
    for (const double unit : units) {
        const double seconds = size * unit;
        if (seconds >= first_date && seconds < last_date) by_date = unit;
        if (seconds < first_date && is_step_between_scans(step * unit)) by_step = unit;
    }
    const bool is_too_fast = by_date && step > 0.0 && step * *by_date < shortest_step;
    return by_date && !(by_step && is_too_fast) ? by_date : by_step;
}

std::vector<double> scaled(std::vector<double> numbers, double unit) {
    for (double& number : numbers) number *= unit;
    return numbers;
}

/// "1700000000" and "12", of "cloud_1700000000_12".
std::vector<double> split_times(const std::vector<NumberInName>& names) {
    constexpr std::size_t padded = 9;
    std::vector<double> times;
    bool are_padded = true;
    for (const NumberInName& name : names) {
        const std::string_view part = name.whole;
        if (!name.before.ends_with('_') || !name.fraction.empty()) return {};
        if (part.empty() || part.size() > padded) return {};
        const std::string_view whole =
            trailing_digits(name.before.substr(0, name.before.size() - 1));
        const std::string_view prefix =
            name.before.substr(0, name.before.size() - 1 - whole.size());
        const bool is_apart = prefix.empty() || prefix.ends_with('_');
        // Who does not write leading zeros writes none.
        const bool is_number = part.size() == padded || part.size() == 1 || part.front() != '0';
        if (!is_apart || !is_number || whole.empty() || value_of(whole) < least_time) return {};
        are_padded &= part.size() == padded;
        times.push_back(value_of(whole) + value_of(part) * 1e-9);
    }
    if (!are_padded && !is_step_between_scans(median_step(times))) return {};
    return times;
}

/// Numbers with a point, in seconds unless a unit is given.
std::vector<double> decimal_times(const std::vector<NumberInName>& names, double unit) {
    std::vector<double> times;
    for (const NumberInName& name : names) {
        const std::string number = std::string(name.whole) + "." + std::string(name.fraction) + "0";
        times.push_back(value_of(number) * unit);
    }
    // Behind a prefix the number may mean anything.
    const bool is_time = names.front().before.empty() || is_step_between_scans(median_step(times));
    return is_time ? times : std::vector<double>{};
}

std::vector<double> whole_times(const std::vector<NumberInName>& names,
                                std::optional<double> unit) {
    std::vector<double> numbers;
    for (const NumberInName& name : names) numbers.push_back(value_of(name.whole));
    if (*std::min_element(numbers.begin(), numbers.end()) < least_time) return {};
    if (!unit) unit = unit_of(numbers);
    return unit ? scaled(std::move(numbers), *unit) : std::vector<double>{};
}

}  // namespace

std::vector<double> times_in_names(const Paths& scans, std::optional<double> unit) {
    std::vector<std::string> stems;
    for (const auto& scan : scans) stems.push_back(scan.stem().string());
    std::vector<NumberInName> names;
    for (const std::string& stem : stems) names.push_back(number_at_end(stem));
    if (names.empty()) return {};
    if (std::vector<double> times = split_times(names); !times.empty()) return times;
    const auto is_other = [&](const NumberInName& name) {
        return name.whole.empty() || name.before != names.front().before;
    };
    if (std::any_of(names.begin(), names.end(), is_other)) return {};
    const bool has_fraction = std::any_of(names.begin(), names.end(), [](const NumberInName& name) {
        return !name.fraction.empty();
    });
    if (!has_fraction) return whole_times(names, unit);
    if (dot_of(stems) == Dot::separator) return {};
    return decimal_times(names, unit.value_or(1.0));
}

std::vector<double> growing_times_in_names(const Paths& scans, std::optional<double> unit) {
    std::vector<double> times = times_in_names(scans, unit);
    if (!std::is_sorted(times.begin(), times.end())) times.clear();
    return times;
}

}  // namespace dynamic_filter::io
