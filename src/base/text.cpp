// SPDX-License-Identifier: MIT
#include "base/text.hpp"

#include <algorithm>
#include <charconv>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

bool Lines::next() {
    if (offset_ >= text_.size()) return false;
    const std::size_t end = text_.find('\n', offset_);
    line_ = text_.substr(offset_, end == std::string_view::npos ? end : end - offset_);
    offset_ += line_.size() + (end == std::string_view::npos ? 0 : 1);
    // Byte order mark of UTF-8.
    if (number_ == 0 && line_.starts_with("\xEF\xBB\xBF")) line_.remove_prefix(3);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    ++number_;
    return true;
}

void Lines::fail(const std::string& what) const {
    throw InputError(file_, "line " + std::to_string(number_), what);
}

std::string_view next_token(std::string_view& rest) {
    std::size_t begin = 0;
    while (begin < rest.size() && is_space(rest[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest.size() && !is_space(rest[end])) ++end;
    const std::string_view token = rest.substr(begin, end - begin);
    rest.remove_prefix(end);
    return token;
}

std::vector<std::string_view> split_tokens(std::string_view line) {
    std::vector<std::string_view> tokens;
    for (auto token = next_token(line); !token.empty(); token = next_token(line)) {
        tokens.push_back(token);
    }
    return tokens;
}

std::vector<std::string_view> split_at(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    for (std::size_t end = line.find(separator); end != std::string_view::npos;
         end = line.find(separator)) {
        cells.push_back(trim(line.substr(0, end)));
        line.remove_prefix(end + 1);
    }
    cells.push_back(trim(line));
    return cells;
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::string to_lower(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

std::optional<double> parse_real(std::string_view token) {
    if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc{} || end != token.data() + token.size()) return std::nullopt;
    return value;
}

std::vector<double> parse_reals(std::string_view text) {
    std::vector<double> values;
    for (const std::string_view word : split_at(text, ',')) {
        const std::optional<double> value = parse_real(word);
        if (!value || !std::isfinite(*value)) return {};
        values.push_back(*value);
    }
    return values;
}

std::optional<std::uint64_t> parse_count(std::string_view token) {
    if (token.empty() || (token.size() > 1 && token.front() == '0')) return std::nullopt;
    if (!std::all_of(token.begin(), token.end(), is_digit)) return std::nullopt;
    std::uint64_t value = 0;
    const auto error = std::from_chars(token.data(), token.data() + token.size(), value).ec;
    if (error != std::errc{}) return std::nullopt;
    return value;
}

std::string quote(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string shown = "'";
    for (const char c : text.substr(0, longest)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > longest ? "...'" : "'");
}

std::optional<std::uint64_t> product(std::uint64_t a, std::uint64_t b) {
    std::uint64_t result = 0;
    if (__builtin_mul_overflow(a, b, &result)) return std::nullopt;
    return result;
}

}  // namespace dynamic_filter::io
