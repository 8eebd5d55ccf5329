// SPDX-License-Identifier: MIT
#include "base/natural_order.hpp"

#include <compare>
#include <string_view>

#include "base/text.hpp"

namespace dynamic_filter::io {
namespace {

/// Removes the digits at the front, and returns them without leading zeros.
std::string_view next_number(std::string_view& rest) {
    std::size_t end = 0;
    while (end < rest.size() && is_digit(rest[end])) ++end;
    std::string_view number = rest.substr(0, end);
    rest.remove_prefix(end);
    while (!number.empty() && number.front() == '0') number.remove_prefix(1);
    return number;
}

/// Compares numbers as strings of digits, so that any length is possible.
std::strong_ordering compare_numbers(std::string_view a, std::string_view b) {
    return a.size() != b.size() ? a.size() <=> b.size() : a.compare(b) <=> 0;
}

std::strong_ordering compare_naturally(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        std::strong_ordering order = std::strong_ordering::equal;
        if (is_digit(a[0]) && is_digit(b[0])) {
            const std::string_view number = next_number(a);
            order = compare_numbers(number, next_number(b));
        } else {
            order = static_cast<unsigned char>(a[0]) <=> static_cast<unsigned char>(b[0]);
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
        if (order != 0) return order;
    }
    return a.size() <=> b.size();
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b) {
    const auto order = compare_naturally(a, b);
    // "a01" and "a1" have equal numbers, but are different names.
    return order == 0 ? a < b : order < 0;
}

}  // namespace dynamic_filter::io
