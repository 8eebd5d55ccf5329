// SPDX-License-Identifier: MIT
/// @file
/// How differently two words are spelled, for messages that name the nearest known word.
///
/// - Units: single-character edits.
/// - Ownership: values.
/// - Threads: pure functions.
/// - Errors: none.
/// - Source: Levenshtein's distance, by the row-wise recurrence of Wagner and Fischer (1974).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dynamic_filter {

/// The smallest number of insertions, deletions and replacements that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `known` with the smallest distance from `given`. A word whose distance is more than
/// half as many characters as `given` has (and more than 2) is too different; if all are, the
/// result is empty. Of equally near words, the first one.
std::string nearest_word(std::string_view given, const std::vector<std::string>& known);

}  // namespace dynamic_filter
