// SPDX-License-Identifier: MIT
/// Text as untrusted input: lines with their numbers, tokens, numbers that ignore the locale.
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

/// Walks the lines of a text (LF or CRLF) and knows where it is, for messages.
class Lines {
public:
    Lines(std::string_view text, std::filesystem::path file)
        : text_(text), file_(std::move(file)) {}

    bool next();  ///< to the next line; false at the end of the text
    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; }  ///< from 1
    [[nodiscard]] std::size_t offset() const { return offset_; }  ///< [bytes] behind the line
    [[nodiscard]] std::string_view text() const { return text_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[noreturn]] void fail(const std::string& what) const;  ///< InputError naming the line

private:
    std::string_view text_, line_;
    std::filesystem::path file_;
    std::size_t number_ = 0, offset_ = 0;
};

/// Cuts the first token off `rest`; empty when there is none left.
std::string_view take_token(std::string_view& rest);
std::vector<std::string_view> split_tokens(std::string_view line);
std::vector<std::string_view> split_at(std::string_view line, char separator);  ///< trimmed
std::string_view trim(std::string_view text);
std::string to_lower(std::string_view text);

/// The whole token as a number: decimal point whatever the locale; nan and inf count as numbers.
std::optional<double> parse_real(std::string_view token);
/// A count as headers write it: digits only, no sign, no leading zero.
std::optional<std::uint64_t> parse_count(std::string_view token);

/// Foreign text made fit for a message: quoted, clipped, printable.
std::string quote(std::string_view text);

/// a * b, or nothing if that overflows.
std::optional<std::uint64_t> product(std::uint64_t a, std::uint64_t b);

}  // namespace dynamic_filter::io
