// SPDX-License-Identifier: MIT
/// The tables of an arena: figures that were measured beside those that were published.
#pragma once

#include <string>
#include <vector>

#include "arena/arena.hpp"

namespace dynamic_filter::app {

/// A figure that this program measured.
struct MeasuredFigure {
    std::string entry, method;
    ArenaScores scores;  ///< parallel to the columns
    std::vector<std::string> notes;
};

/// Adds the means of the entries with one group, "station" of "station/sequence_1" and so on, where
/// all entries of the group were measured.
void add_means_of_groups(const Arena& arena, std::vector<MeasuredFigure>& figures);

/// Markdown: the rows of each entry, first those that were measured.
std::string arena_markdown(const Arena& arena, const std::vector<MeasuredFigure>& figures);
/// {"arena", "title", "columns", "rows": [{"entry", "method", "scores": {column: 0..1 or null},
/// "measured", "how", "source"}]}
std::string arena_json(const Arena& arena, const std::vector<MeasuredFigure>& figures);
/// The measured rows of a table that arena_json() wrote, without means; empty if it is of another
/// arena, or cannot be read.
std::vector<MeasuredFigure> measured_in(const Arena& arena, const std::string& json);
/// What others published: a Markdown table for each column of which there is a figure, with a row
/// for each method and a column for each entry.
std::string published_markdown(const Arena& arena);
/// One line for the console.
std::string figure_text(const Arena& arena, const MeasuredFigure& figure);

}  // namespace dynamic_filter::app
