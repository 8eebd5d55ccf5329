// SPDX-License-Identifier: MIT
/// Reads untrusted text: lines with their numbers, tokens, and numbers independent of the locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dynamic_filter::io {

/// Iterates over the lines of a text (LF or CRLF), and knows the position for messages.
class Lines {
public:
    Lines(std::string_view text, std::filesystem::path file)
        : text_(text), file_(std::move(file)) {}

    bool next();  ///< goes to the next line; false at the end of the text
    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; }  ///< from 1
    /// [bytes] position after the line.
    [[nodiscard]] std::size_t offset() const { return offset_; }
    [[nodiscard]] std::string_view text() const { return text_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    /// Throws InputError that names the line.
    [[noreturn]] void fail(const std::string& what) const;

private:
    std::string_view text_, line_;
    std::filesystem::path file_;
    std::size_t number_ = 0, offset_ = 0;
};

/// Removes the first token from `rest` and returns it; empty if there is none left.
std::string_view next_token(std::string_view& rest);
std::vector<std::string_view> split_tokens(std::string_view line);
/// Parts without blanks at their ends.
std::vector<std::string_view> split_at(std::string_view line, char separator);
std::string_view trim(std::string_view text);
std::string to_lower(std::string_view text);
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter_or_digit(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
/// True for lines of pose files that hold no data; the line has no blanks at its ends.
inline bool is_blank_or_comment(std::string_view line) {
    return line.empty() || line.front() == '#';
}

/// Reads the whole token as a number. The decimal separator is always a point; nan and inf are
/// numbers.
std::optional<double> parse_real(std::string_view token);
/// Reads finite numbers with commas between them; empty if one of them is none.
std::vector<double> parse_reals(std::string_view text);
/// Reads a count as in headers: only digits, no sign, no leading zero.
std::optional<std::uint64_t> parse_count(std::string_view token);

/// Makes untrusted text safe for a message: quoted, shortened, printable.
std::string quote(std::string_view text);

/// Returns a * b, or nothing if that overflows.
std::optional<std::uint64_t> product(std::uint64_t a, std::uint64_t b);

}  // namespace dynamic_filter::io
