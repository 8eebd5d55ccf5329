// SPDX-License-Identifier: MIT
#include "base/natural_order.hpp"

#include <algorithm>
#include <compare>
#include <numeric>
#include <string_view>

#include "base/text.hpp"

namespace dynamic_filter::io {
namespace {

/// A number, or a single other character.
struct Part {
    /// The first one; it decides between a number and another character.
    unsigned char character = 0;
    std::string_view whole{};     // without leading zeros
    std::string_view fraction{};  // as it is written
};
using Parts = std::vector<Part>;

std::string_view leading_digits(std::string_view text) {
    std::size_t end = 0;
    while (end < text.size() && is_digit(text[end])) ++end;
    return text.substr(0, end);
}

std::string_view without_leading_zeros(std::string_view digits) {
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

std::string_view without_trailing_zeros(std::string_view digits) {
    while (digits.ends_with('0')) digits.remove_suffix(1);
    return digits;
}

/// The digits behind a point at the front of `text`.
std::string_view digits_behind_point(std::string_view text) {
    return text.starts_with('.') ? leading_digits(text.substr(1)) : std::string_view{};
}

Parts parts_of(std::string_view name, Dot dot) {
    Parts parts;
    bool is_chain = false;  // numbers with points between them, so far
    while (!name.empty()) {
        const std::string_view digits = leading_digits(name);
        if (digits.empty()) {
            is_chain &= name.front() == '.';
            parts.push_back({.character = static_cast<unsigned char>(name.front())});
            name.remove_prefix(1);
            continue;
        }
        name.remove_prefix(digits.size());
        Part number{.character = '0', .whole = without_leading_zeros(digits)};
        const std::string_view next = digits_behind_point(name);
        const bool goes_on =
            !next.empty() && !digits_behind_point(name.substr(1 + next.size())).empty();
        if (dot == Dot::decimal && !is_chain && !goes_on && !next.empty()) {
            number.fraction = next;
            name.remove_prefix(1 + next.size());
        } else {
            is_chain = !next.empty();
        }
        parts.push_back(number);
    }
    return parts;
}

/// Compares numbers as strings of digits, so that any length is possible.
std::strong_ordering compare(const Part& a, const Part& b) {
    if (a.character != b.character) return a.character <=> b.character;
    if (a.whole.size() != b.whole.size()) return a.whole.size() <=> b.whole.size();
    if (const int order = a.whole.compare(b.whole)) return order <=> 0;
    return without_trailing_zeros(a.fraction).compare(without_trailing_zeros(b.fraction)) <=> 0;
}

std::strong_ordering compare(const Parts& a, const Parts& b) {
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        if (const auto order = compare(a[i], b[i]); order != 0) return order;
    }
    return a.size() <=> b.size();
}

bool is_less(const Parts& a, const Parts& b, const std::string& name_a, const std::string& name_b) {
    const auto order = compare(a, b);
    // "a01" and "a1" have equal numbers, but are different names.
    return order == 0 ? name_a < name_b : order < 0;
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b, Dot dot) {
    return is_less(parts_of(a, dot), parts_of(b, dot), a, b);
}

Dot dot_of(const std::vector<std::string>& names) {
    std::size_t shortest = std::string::npos, longest = 0;
    bool has_zero =
        false;  // one that need not be there; "1.0" has to tell that it is no whole number
    for (const std::string& name : names) {
        for (const Part& part : parts_of(name, Dot::decimal)) {
            if (part.fraction.empty()) continue;
            shortest = std::min(shortest, part.fraction.size());
            longest = std::max(longest, part.fraction.size());
            has_zero |= part.fraction.size() > 1 && part.fraction.ends_with('0');
        }
    }
    return has_zero && shortest < longest ? Dot::separator : Dot::decimal;
}

void sort_naturally(std::vector<std::filesystem::path>& files) {
    std::vector<std::string> names;
    names.reserve(files.size());
    for (const auto& file : files) names.push_back(file.filename().string());
    const Dot dot = dot_of(names);
    std::vector<Parts> parts;
    parts.reserve(files.size());
    for (const std::string& name : names) parts.push_back(parts_of(name, dot));
    std::vector<std::size_t> order(files.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return is_less(parts[a], parts[b], names[a], names[b]);
    });
    std::vector<std::filesystem::path> sorted;
    sorted.reserve(files.size());
    for (const std::size_t i : order) sorted.push_back(std::move(files[i]));
    files = std::move(sorted);
}

}  // namespace dynamic_filter::io
