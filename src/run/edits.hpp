// SPDX-License-Identifier: MIT
/// Corrections of a run by hand: edits.json, see docs/editing.md.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// `count` cells in a row along x, beginning at (x, y, z); cell c covers [c, c + 1) * cell_size.
struct CellRun {
    std::int32_t x = 0, y = 0, z = 0;
    std::uint32_t count = 1;
    bool operator==(const CellRun&) const = default;
};

/// One correction. `cells` by verdict_code() of the filter's verdict: the edit changes only points
/// of that verdict in those cells.
struct Edit {
    Label label = Label::unknown;
    std::array<std::vector<CellRun>, 3> cells;
    std::optional<std::pair<std::uint32_t, std::uint32_t>> scans;  ///< first and last row; all
    std::string how;  ///< for the list in the page: click, box or lasso
    bool operator==(const Edit&) const = default;
};

/// Edits in the order in which they were made. If two concern the same point, the later one holds.
struct Edits {
    double cell_size = 0.2;  ///< [m]
    std::vector<Edit> edits;
};

inline constexpr const char* kEditsFile = "edits.json";

/// Throws InputError, naming `file` and the place in it: no JSON, another version, damaged.
Edits parse_edits(const std::string& text, const std::filesystem::path& file);
Edits read_edits(const std::filesystem::path& file);
std::string text_of(const Edits& edits);

}  // namespace dynamic_filter::app
