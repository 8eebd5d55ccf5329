// SPDX-License-Identifier: MIT
#include "run/edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace dynamic_filter::app {

namespace {

using nlohmann::ordered_json;

constexpr const char* kFormat = "dynamicfilter edits";
constexpr int kVersion = 1;
constexpr std::uint64_t kMostCells = 20'000'000;  ///< of a file: about 1 GB of memory
/// Names of labels, indexed by verdict_code().
constexpr std::array<const char*, 3> kNames = {"unknown", "static", "dynamic"};
constexpr std::array<Label, 3> kLabels = {Label::unknown, Label::static_, Label::dynamic};

/// The place in the file that the parser reads, for its messages.
struct EditsPlace {
    const std::filesystem::path& file;
    std::string where;
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(file, where,
                         what +
                             "; mend the file, or move it away and mark the points again with "
                             "`dynamicfilter serve RUN --edit`");
    }
};

std::size_t code_of(const nlohmann::json& name, const EditsPlace& place) {
    for (std::size_t code = 0; code < kNames.size(); ++code) {
        if (name == kNames[code]) return code;
    }
    place.fail("expected static, dynamic or unknown, not " + name.dump());
}

std::int64_t whole(const nlohmann::json& value, std::int64_t least, std::int64_t most,
                   const EditsPlace& place) {
    const bool fits = value.is_number_integer() &&
                      (!value.is_number_unsigned() ||
                       value.get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX)) &&
                      value.get<std::int64_t>() >= least && value.get<std::int64_t>() <= most;
    if (!fits) {
        place.fail(fmt::format("expected a whole number from {} to {}, not {}", least, most,
                               value.dump()));
    }
    return value.get<std::int64_t>();
}

std::vector<CellRun> runs_of(const nlohmann::json& numbers, std::uint64_t& total,
                             const EditsPlace& place) {
    if (!numbers.is_array() || numbers.size() % 4 != 0) {
        place.fail("expected an array of x, y, z, count, x, y, z, count, ...");
    }
    std::vector<CellRun> runs;
    for (std::size_t i = 0; i < numbers.size(); i += 4) {
        const auto cell = [&](std::size_t k) {
            return static_cast<std::int32_t>(
                whole(numbers[i + k], -1'000'000'000, 1'000'000'000, place));
        };
        const std::int64_t count = whole(numbers[i + 3], 1, 1'000'000, place);
        runs.push_back({cell(0), cell(1), cell(2), static_cast<std::uint32_t>(count)});
        total += static_cast<std::uint64_t>(count);
        if (total > kMostCells) {
            place.fail(fmt::format("the file holds more than {} cells", kMostCells));
        }
    }
    return runs;
}

Edit edit_of(const nlohmann::json& entry, std::uint64_t& total, const EditsPlace& place) {
    if (!entry.is_object() || !entry.contains("label") || !entry.contains("cells") ||
        !entry["cells"].is_object()) {
        place.fail("expected an object with `label` and `cells`");
    }
    Edit edit;
    edit.label = kLabels[code_of(entry["label"], place)];
    for (const auto& [from, numbers] : entry["cells"].items()) {
        edit.cells[code_of(from, place)] = runs_of(numbers, total, place);
    }
    if (entry.contains("scans")) {
        const nlohmann::json& scans = entry["scans"];
        if (!scans.is_array() || scans.size() != 2) {
            place.fail("expected `scans` as [first, last]");
        }
        const auto row = [&](std::size_t k) {
            return static_cast<std::uint32_t>(whole(scans[k], 0, UINT32_MAX, place));
        };
        edit.scans = {row(0), row(1)};
        if (edit.scans->first > edit.scans->second) place.fail("`scans` ends before it begins");
    }
    if (entry.contains("how") && entry["how"].is_string()) edit.how = entry["how"];
    return edit;
}

}  // namespace

Edits parse_edits(const std::string& text, const std::filesystem::path& file) {
    const EditsPlace top{file, ""};
    const nlohmann::json all = nlohmann::json::parse(text, nullptr, false);
    if (!all.is_object() || all.value("format", nlohmann::json()) != kFormat) {
        top.fail(
            fmt::format("is damaged or no file of edits; expected JSON with \"format\": "
                        "\"{}\"",
                        kFormat));
    }
    if (all.value("version", nlohmann::json()) != kVersion) {
        throw InputError(file, "",
                         fmt::format("is of version {}, and this command reads version {}; use the "
                                     "dynamicfilter that wrote it (`dynamicfilter --version`)",
                                     all.value("version", nlohmann::json()).dump(), kVersion));
    }
    const nlohmann::json size = all.value("cell_size", nlohmann::json());
    if (!size.is_number() || !(size.get<double>() >= 0.01 && size.get<double>() <= 100.0)) {
        top.fail("expected `cell_size` from 0.01 to 100 m");
    }
    const nlohmann::json& list = all.contains("edits") ? all["edits"] : nlohmann::json();
    if (!list.is_array()) top.fail("expected an array `edits`");
    Edits edits{size.get<double>(), {}};
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        edits.edits.push_back(edit_of(list[i], total, {file, fmt::format("edit {}", i + 1)}));
    }
    return edits;
}

Edits read_edits(const std::filesystem::path& file) {
    return parse_edits(io::read_file(file), file);
}

std::string text_of(const Edits& edits) {
    std::string text = fmt::format(
        "{{\"format\": \"{}\", \"version\": {}, \"cell_size\": {},\n"
        "\"edits\": [",
        kFormat, kVersion, ordered_json(edits.cell_size).dump());
    for (std::size_t i = 0; i < edits.edits.size(); ++i) {  // one a line: easy to compare
        const Edit& edit = edits.edits[i];
        const auto code = static_cast<std::size_t>(
            std::find(kLabels.begin(), kLabels.end(), edit.label) - kLabels.begin());
        ordered_json json{{"label", kNames[code]}};
        if (!edit.how.empty()) json["how"] = edit.how;
        if (edit.scans) json["scans"] = {edit.scans->first, edit.scans->second};
        json["cells"] = ordered_json::object();
        for (std::size_t from = 0; from < kNames.size(); ++from) {
            if (edit.cells[from].empty()) continue;
            auto& numbers = json["cells"][kNames[from]] = ordered_json::array();
            for (const CellRun& run : edit.cells[from]) {
                for (const std::int64_t value : {std::int64_t{run.x}, std::int64_t{run.y},
                                                 std::int64_t{run.z}, std::int64_t{run.count}}) {
                    numbers.push_back(value);
                }
            }
        }
        text += (i == 0 ? "\n" : ",\n") +
                json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    }
    return text + "\n]}\n";
}

}  // namespace dynamic_filter::app
