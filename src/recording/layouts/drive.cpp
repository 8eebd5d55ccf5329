// SPDX-License-Identifier: MIT
#include "recording/layouts/drive.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/numbers.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

/// Three numbers with `separator` between them.
std::optional<std::array<double, 3>> three(std::string_view text, char separator) {
    const auto cells = split_at(text, separator);
    if (cells.size() != 3) return std::nullopt;
    std::array<double, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = parse_real(cells[i]);
        if (!number || !(*number >= 0.0) || *number > 9999.0) return std::nullopt;
        numbers[i] = *number;
    }
    return numbers;
}

/// Converts "2011-09-26 13:02:25.951199337" to seconds since 1970.
std::optional<double> seconds_of(std::string_view line) {
    const auto tokens = split_tokens(line);
    const auto date = tokens.size() == 2 ? three(tokens[0], '-') : std::nullopt;
    const auto time = tokens.size() == 2 ? three(tokens[1], ':') : std::nullopt;
    if (!date || !time) return std::nullopt;
    using namespace std::chrono;
    const year_month_day day{year(static_cast<int>((*date)[0])),
                             month(static_cast<unsigned>((*date)[1])),
                             std::chrono::day(static_cast<unsigned>((*date)[2]))};
    if (!day.ok() || (*time)[0] >= 24.0 || (*time)[1] >= 60.0 || (*time)[2] >= 61.0) {
        return std::nullopt;
    }
    const auto days = static_cast<double>(sys_days(day).time_since_epoch().count());
    return 86400.0 * days + 3600.0 * (*time)[0] + 60.0 * (*time)[1] + (*time)[2];
}

/// One stamp per line; blank lines stand for missing scans.
std::vector<std::optional<double>> read_timestamps(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    std::vector<std::optional<double>> rows;
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        rows.push_back(line.empty() ? std::nullopt : seconds_of(line));
        if (!line.empty() && !rows.back()) {
            lines.fail(quote(line) + " is no time; expected such as 2011-09-26 13:02:25.951199337");
        }
    }
    return rows;
}

std::vector<double> stamps_of(const Layout& layout, const fs::path& file) {
    const auto rows = read_timestamps(file);
    const bool by_order = rows.size() == layout.scans.size();
    std::vector<double> stamps;
    for (std::size_t i = 0; i < layout.scans.size(); ++i) {
        const auto row = by_order ? std::optional(i) : index_of(layout.scans[i]);
        if (!row || *row >= rows.size()) {
            throw InputError(
                file, "",
                fmt::format("{} timestamps but {} scans in {}, and none for {}", rows.size(),
                            layout.scans.size(), layout.scan_folder.string(),
                            layout.scans[i].filename().string()));
        }
        if (!rows[*row]) {
            throw InputError(
                file, fmt::format("line {}", *row + 1),
                "is blank; it should be the time of " + layout.scans[i].filename().string());
        }
        stamps.push_back(*rows[*row]);
    }
    return stamps;
}

}  // namespace

bool is_drive(const fs::path& folder) { return is_folder(folder / "velodyne_points" / "data"); }

std::optional<fs::path> drive_of(const fs::path& data) {
    if (is_drive(data)) return data;
    fs::path folder = whole_path(data);
    if (folder.filename() == "data") folder = folder.parent_path();
    if (folder.filename() != "velodyne_points" || !is_drive(folder.parent_path())) {
        return std::nullopt;
    }
    return folder.parent_path();
}

Layout scans_of_drive(const fs::path& drive) {
    Layout layout;
    layout.scan_folder = drive / "velodyne_points" / "data";
    layout.scans = list_files(layout.scan_folder, {".bin"});
    if (layout.scans.empty()) throw InputError(layout.scan_folder, "", "no *.bin found");
    const fs::path stamps = drive / "velodyne_points" / "timestamps.txt";
    if (present(stamps)) layout.stamps = stamps_of(layout, stamps);
    return layout;
}

bool needs_no_poses(Layout& layout, const OpenOptions& options) {
    layout.poses = options.poses;
    return options.poses || options.without_poses;
}

}  // namespace dynamic_filter::io
