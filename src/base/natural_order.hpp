// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dynamic_filter::io {

/// How a point between two whole numbers is read.
enum class Dot {
    decimal,    ///< "1.05" is before "1.1"
    separator,  ///< "1.9" is before "1.10"
};

/// Natural order of names: "a2" is before "a10". Three and more numbers with points between them
/// (a date, a version) are always whole numbers.
bool natural_less(const std::string& a, const std::string& b, Dot dot = Dot::decimal);

/// How points are read in names that belong together: decimal, unless fractions differ in length
/// and one of them ends in a zero, which nobody writes who leaves zeros out.
Dot dot_of(const std::vector<std::string>& names);

/// Sorts by the natural order of the file names.
void sort_naturally(std::vector<std::filesystem::path>& files);

}  // namespace dynamic_filter::io
