// SPDX-License-Identifier: MIT
/// The layouts that are known. A new one is a file with its finder, and a row of registry.cpp.
#pragma once

#include <vector>

#include "dynamic_filter/error.hpp"
#include "recording/layouts/layouts.hpp"

namespace dynamic_filter::io {

/// When a layout is asked, if the user names none.
enum class Turn {
    bag,       ///< before all others; a bag is no folder of scans, and has no finder
    rig,       ///< a file that names several recordings; it has no finder either
    path,      ///< first, also for a path that does not exist, because its end may name a part
    contents,  ///< by files that no other layout has
    usual,     ///< last, after a look at the folders below
};

struct LayoutRow {
    LayoutName name;
    Turn turn;
    std::optional<Layout> (*find)(const Place& place);
};

/// All rows, in the order in which they are asked.
const std::vector<LayoutRow>& layout_rows();

/// Asks the finder of a row. The layout that it returns has the name of the row.
std::optional<Layout> ask(const LayoutRow& row, const Place& place);

/// The first layout of this turn that fits; empty if none does.
std::optional<Layout> find_in_turn(Turn turn, const Place& place);

/// The row with this name. Throws ConfigError with all names if there is none.
const LayoutRow& layout_row(const std::string& name);

/// What to throw if a path that is said to be of a layout is not.
InputError not_of_layout(const std::filesystem::path& data, const LayoutRow& row);

}  // namespace dynamic_filter::io
