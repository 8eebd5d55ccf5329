// SPDX-License-Identifier: MIT
#include "arena/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

constexpr const char* kOurs = "final verdicts";  // after the last scan

std::string cell(const ArenaColumn& column, const std::optional<double>& score) {
    return column.is_percent ? percent(score) : three_digits(score);
}

std::string title_of(const ArenaColumn& column) {
    return column.is_percent ? column.name + " [%]" : column.name;
}

/// The names of entries in their order, each once.
std::vector<std::string> entries_of(const std::vector<MeasuredFigure>& figures) {
    std::vector<std::string> entries;
    for (const MeasuredFigure& figure : figures) {
        if (std::find(entries.begin(), entries.end(), figure.entry) == entries.end()) {
            entries.push_back(figure.entry);
        }
    }
    return entries;
}

bool has_group(const std::string& entry) { return entry.find('/') != std::string::npos; }

/// Those of a group stand at its mean.
std::vector<PublishedFigure> published_at(const Arena& arena, const std::string& entry) {
    if (has_group(entry)) return {};
    return published_figures(arena.name, entry);
}

/// The figures of a method in one column, by entry.
struct MethodRow {
    std::string method, how, source;
    ArenaScores scores;
};

std::vector<MethodRow> published_rows(const Arena& arena, const std::vector<std::string>& entries,
                                      std::size_t column) {
    std::vector<MethodRow> rows;
    for (std::size_t e = 0; e < entries.size(); ++e) {
        for (const PublishedFigure& figure : published_figures(arena.name, entries[e])) {
            if (!figure.scores[column]) continue;
            auto row = std::find_if(rows.begin(), rows.end(), [&](const MethodRow& r) {
                return r.method == figure.method && r.source == figure.source;
            });
            if (row == rows.end()) {
                rows.push_back(
                    {figure.method, figure.how, figure.source, ArenaScores(entries.size())});
                row = rows.end() - 1;
            }
            row->scores[e] = figure.scores[column];
        }
    }
    return rows;
}

std::string row_of(const Arena& arena, const std::string& entry, const std::string& method,
                   const ArenaScores& scores, const std::string& how, const std::string& source) {
    std::string row = fmt::format("| {} | {} |", entry, method);
    for (std::size_t c = 0; c < arena.columns.size(); ++c) {
        row += fmt::format(" {} |", cell(arena.columns[c], scores[c]));
    }
    return row + fmt::format(" {} | {} |\n", how, source);
}

std::string head_of(const Arena& arena) {
    std::string head = "| entry | method |", line = "|---|---|";
    for (const ArenaColumn& column : arena.columns) {
        head += fmt::format(" {} |", title_of(column));
        line += "---|";
    }
    return head + " how | source |\n" + line + "---|---|\n";
}

nlohmann::ordered_json scores_json(const Arena& arena, const ArenaScores& scores) {
    nlohmann::ordered_json json;
    for (std::size_t c = 0; c < arena.columns.size(); ++c) {
        json[arena.columns[c].name] = share_or_null(scores[c]);
    }
    return json;
}

}  // namespace

void add_means_of_groups(const Arena& arena, std::vector<MeasuredFigure>& figures) {
    std::vector<MeasuredFigure> means;
    std::vector<std::vector<std::size_t>> counts;  // by mean and column
    std::vector<std::size_t> entries;              // by mean
    for (const MeasuredFigure& figure : figures) {
        if (!has_group(figure.entry)) continue;
        const std::string group = group_of_entry(figure.entry);
        auto mean = std::find_if(means.begin(), means.end(), [&](const MeasuredFigure& m) {
            return m.entry == group && m.method == figure.method;
        });
        if (mean == means.end()) {
            means.push_back(figure);
            means.back().entry = group;
            means.back().notes.clear();
            means.back().scores.assign(figure.scores.size(), std::nullopt);
            counts.emplace_back(figure.scores.size());
            entries.push_back(0);
            mean = means.end() - 1;
        }
        const auto m = static_cast<std::size_t>(mean - means.begin());
        ++entries[m];
        auto& count = counts[m];
        for (std::size_t c = 0; c < figure.scores.size(); ++c) {
            if (!figure.scores[c]) continue;
            mean->scores[c] = mean->scores[c].value_or(0.0) + *figure.scores[c];
            ++count[c];
        }
    }
    for (std::size_t m = 0; m < means.size(); ++m) {
        const auto all = std::count_if(
            arena.entries.begin(), arena.entries.end(),
            [&](const std::string& entry) { return group_of_entry(entry) == means[m].entry; });
        if (std::cmp_not_equal(entries[m], all)) continue;
        for (std::size_t c = 0; c < counts[m].size(); ++c) {
            if (means[m].scores[c]) *means[m].scores[c] /= static_cast<double>(counts[m][c]);
        }
        figures.push_back(means[m]);
    }
}

std::string arena_markdown(const Arena& arena, const std::vector<MeasuredFigure>& figures) {
    std::string text = fmt::format("# {}\n\n", arena.title) + head_of(arena);
    for (const std::string& entry : entries_of(figures)) {
        for (const MeasuredFigure& figure : figures) {
            if (figure.entry != entry) continue;
            text += row_of(arena, entry, figure.method, figure.scores, kOurs,
                           fmt::format("measured here{}{}", figure.notes.empty() ? "" : "; ",
                                       fmt::join(figure.notes, "; ")));
        }
        for (const PublishedFigure& figure : published_at(arena, entry)) {
            text += row_of(arena, entry, figure.method, figure.scores, figure.how, figure.source);
        }
    }
    return text;
}

std::string arena_json(const Arena& arena, const std::vector<MeasuredFigure>& figures) {
    nlohmann::ordered_json json{{"arena", arena.name}, {"title", arena.title}};
    for (const ArenaColumn& column : arena.columns) json["columns"].push_back(column.name);
    json["rows"] = nlohmann::ordered_json::array();
    for (const std::string& entry : entries_of(figures)) {
        for (const MeasuredFigure& figure : figures) {
            if (figure.entry != entry) continue;
            json["rows"].push_back({{"entry", entry},
                                    {"method", figure.method},
                                    {"scores", scores_json(arena, figure.scores)},
                                    {"measured", true},
                                    {"how", kOurs},
                                    {"source", "measured here"},
                                    {"notes", figure.notes}});
        }
        for (const PublishedFigure& figure : published_at(arena, entry)) {
            json["rows"].push_back({{"entry", entry},
                                    {"method", figure.method},
                                    {"scores", scores_json(arena, figure.scores)},
                                    {"measured", false},
                                    {"how", figure.how},
                                    {"source", figure.source}});
        }
    }
    return text_of(json);
}

std::vector<MeasuredFigure> measured_in(const Arena& arena, const std::string& text) {
    std::vector<MeasuredFigure> figures;
    try {
        const auto json = nlohmann::ordered_json::parse(text);
        if (json.at("arena") != arena.name) return {};
        for (const auto& row : json.at("rows")) {
            const std::string entry = row.at("entry");
            const bool is_mean = std::find(arena.entries.begin(), arena.entries.end(), entry) ==
                                     arena.entries.end() &&
                                 !arena.entries_in;
            if (!row.at("measured").get<bool>() || is_mean) continue;
            MeasuredFigure& figure = figures.emplace_back();
            figure.entry = entry;
            figure.method = row.at("method");
            for (const ArenaColumn& column : arena.columns) {
                const auto& score = row.at("scores").at(column.name);
                figure.scores.push_back(score.is_null() ? std::nullopt
                                                        : std::optional(score.get<double>()));
            }
            figure.notes = row.at("notes").get<std::vector<std::string>>();
        }
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return figures;
}

std::string published_markdown(const Arena& arena) {
    std::vector<std::string> entries;
    for (const std::string& entry : arena.entries) {
        const std::string group = group_of_entry(entry);
        const bool is_new = std::find(entries.begin(), entries.end(), group) == entries.end();
        if (is_new && !published_figures(arena.name, group).empty()) entries.push_back(group);
    }
    std::string text;
    for (std::size_t c = 0; c < arena.columns.size(); ++c) {
        const auto rows = published_rows(arena, entries, c);
        if (rows.empty()) continue;
        text += fmt::format("\n**{}**\n\n| method | {} | how | source |\n|---|",
                            title_of(arena.columns[c]), fmt::join(entries, " | "));
        for (std::size_t e = 0; e < entries.size() + 2; ++e) text += "---|";
        text += "\n";
        for (const MethodRow& row : rows) {
            text += fmt::format("| {} |", row.method);
            for (const auto& score : row.scores) {
                text += fmt::format(" {} |", cell(arena.columns[c], score));
            }
            text += fmt::format(" {} | {} |\n", row.how, row.source);
        }
    }
    return text;
}

std::string figure_text(const Arena& arena, const MeasuredFigure& figure) {
    std::string text = fmt::format("{:<10} {:<18}", figure.entry, figure.method);
    for (std::size_t c = 0; c < arena.columns.size(); ++c) {
        text +=
            fmt::format("  {} {}", arena.columns[c].name, cell(arena.columns[c], figure.scores[c]));
    }
    return text + "\n";
}

}  // namespace dynamic_filter::app
