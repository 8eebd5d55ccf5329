// SPDX-License-Identifier: MIT
#include "formats/poses/pose_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t rows_34 = 12, rows_44 = 16, tum_columns = 8, row_of_matrix = 4;

/// [m] length of the path in the given order; poses of lost tracking are passed over.
double path_length(const std::vector<Pose>& poses, const std::vector<std::size_t>& order) {
    double length = 0.0;
    const Pose* last = nullptr;
    for (const std::size_t i : order) {
        if (!poses[i].matrix().allFinite()) continue;
        if (last != nullptr) length += (poses[i].translation() - last->translation()).norm();
        last = &poses[i];
    }
    return length;
}

[[noreturn]] void explain_columns(std::size_t columns, const Lines& lines) {
    std::string hint =
        "expected 12 (KITTI, 3x4 row by row) or 16 (4x4), 13 or 17 (the same after a stamp or an "
        "index), 4 (the rows of 4x4 matrices) or 8 (TUM: t x y z qx qy qz qw)";
    if (columns == 7) {
        hint +=
            "; 7 are a position and a quaternion, which some programs begin with w and others end "
            "with it; put a line that tells it first: x y z qw qx qy qz, or x y z qx qy qz qw";
    }
    lines.fail(fmt::format("{} columns; {}", columns, hint));
}

/// `first`: column of the first number of the matrix.
Pose pose_of_matrix(const std::vector<double>& row, std::size_t first, const Lines& lines) {
    if (!are_finite(row)) return lost_pose();
    return pose_from_rows(Eigen::Map<const Rows34>(row.data() + first), lines);
}

/// Throws unless the last row of the 4x4 matrix is 0 0 0 1.
void check_last_row(const std::vector<double>& row, std::size_t first, const Lines& lines) {
    constexpr double rounding = 1e-6;
    const double* const m = row.data() + first;
    const auto is_unit = [&](std::size_t begin, std::size_t step) {
        const double a = m[begin], b = m[begin + step], c = m[begin + 2 * step];
        return std::abs(a) + std::abs(b) + std::abs(c) + std::abs(m[15] - 1.0) < rounding;
    };
    if (!are_finite(row) || is_unit(12, 1)) return;
    lines.fail(fmt::format(
        "the last row of the 4x4 matrix is {:.6g} {:.6g} {:.6g} {:.6g}; expected 0 0 0 1{}", m[12],
        m[13], m[14], m[15],
        is_unit(3, 4) ? "; the matrix is transposed (column by column): write it row by row" : ""));
}

Pose tum_pose(const std::vector<double>& row, const Lines& lines) {
    if (!are_finite(row)) return lost_pose();
    return pose_from_quaternion({row[1], row[2], row[3]},
                                Eigen::Quaterniond(row[7], row[4], row[5], row[6]),
                                "t x y z qx qy qz qw (xyzw)", lines);
}

/// Throws for EuRoC's columns without their header, because TUM has as many.
void refuse_unclear_order(double stamp, const Lines& lines) {
    constexpr double least_nanoseconds = 1e14;  // in seconds, such a date is far in the future
    if (lines.line().find(',') == std::string_view::npos || !(stamp >= least_nanoseconds)) return;
    lines.fail(
        "8 columns with nanoseconds and no header: EuRoC has qw before qx qy qz, TUM behind them; "
        "put a line that tells it first, such as timestamp,x,y,z,qw,qx,qy,qz");
}

/// True if the stamps only count the rows, from any whole number.
bool are_indices(const std::vector<double>& stamps) {
    constexpr double first_time = 1e8;  // larger whole numbers are times
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        if (stamps[i] != stamps[0] + static_cast<double>(i)) return false;
    }
    return stamps.size() > 1 && stamps[0] == std::floor(stamps[0]) && stamps[0] < first_time;
}

bool are_whole(const std::vector<double>& stamps) {
    return std::all_of(stamps.begin(), stamps.end(), [](double s) { return s == std::floor(s); });
}

/// Reads one row after another.
class RowReader {
public:
    explicit RowReader(const Lines& lines) : lines_(lines) {}

    void read(const std::vector<double>& row) {
        if (columns_ == 0) columns_ = row.size();
        if (row.size() != columns_) {
            lines_.fail(fmt::format("{} columns; the rows before have {}", row.size(), columns_));
        }
        if (columns_ == tum_columns) {
            refuse_unclear_order(row[0], lines_);
            append_stamp(rows_, row[0], lines_);
            rows_.file.poses.push_back(tum_pose(row, lines_));
        } else if (columns_ == rows_34 || columns_ == rows_44) {
            read_matrix(row, 0);
        } else if (columns_ == rows_34 + 1 || columns_ == rows_44 + 1) {
            append_stamp(rows_, row[0], lines_);
            read_matrix(row, 1);
        } else if (columns_ == row_of_matrix) {
            read_row_of_matrix(row);
        } else {
            explain_columns(columns_, lines_);
        }
    }

    PoseRows finish(bool has_commas) {
        if (!matrix_.empty()) {
            lines_.fail(fmt::format("the file ends after {} of the 4 rows of a 4x4 matrix",
                                    matrix_.size() / row_of_matrix));
        }
        std::vector<double>& stamps = rows_.file.stamps;
        if (columns_ == tum_columns) return std::move(rows_);
        if (are_indices(stamps)) stamps.clear();
        if (has_commas && are_whole(stamps)) {  // MulRan
            for (double& stamp : stamps) stamp *= 1e-9;
        }
        return std::move(rows_);
    }

private:
    void read_matrix(const std::vector<double>& row, std::size_t first) {
        if (row.size() - first == rows_44) check_last_row(row, first, lines_);
        rows_.file.poses.push_back(pose_of_matrix(row, first, lines_));
    }

    void read_row_of_matrix(const std::vector<double>& row) {
        matrix_.insert(matrix_.end(), row.begin(), row.end());
        if (matrix_.size() < rows_44) return;
        read_matrix(matrix_, 0);
        matrix_.clear();
    }

    const Lines& lines_;
    PoseRows rows_;
    std::size_t columns_ = 0;
    std::vector<double> matrix_;  // the rows so far of a matrix over several lines
};

}  // namespace

void append_stamp(PoseRows& rows, double stamp, const Lines& where) {
    if (!std::isfinite(stamp)) where.fail("the stamp is not finite");
    std::vector<double>& stamps = rows.file.stamps;
    if (rows.back == 0 && !stamps.empty() && stamp < stamps.back()) rows.back = where.number();
    stamps.push_back(stamp);
}

PoseFile in_order(PoseRows rows, const std::filesystem::path& file) {
    const std::vector<double>& stamps = rows.file.stamps;
    if (rows.back == 0 || stamps.empty()) return std::move(rows.file);
    std::vector<std::size_t> order(stamps.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const double as_written = path_length(rows.file.poses, order);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return stamps[a] < stamps[b]; });
    constexpr double rounding = 1e-9;
    if (path_length(rows.file.poses, order) > as_written * (1.0 + rounding)) {
        throw InputError(file, fmt::format("line {}", rows.back),
                         "its stamp is before that of the row above, and sorted by time, the path "
                         "is longer than as written: are these several trajectories? keep one");
    }
    PoseFile sorted;
    for (const std::size_t i : order) {
        sorted.stamps.push_back(stamps[i]);
        sorted.poses.push_back(rows.file.poses[i]);
    }
    sorted.notes.push_back(
        fmt::format("the rows of {} are not in the order of time (line {} is the first that is "
                    "not); they were sorted",
                    file.string(), rows.back));
    return sorted;
}

std::vector<std::string_view> cells_of(std::string_view line) {
    if (line.find(',') == std::string_view::npos) return split_tokens(line);
    std::vector<std::string_view> cells = split_at(line, ',');
    if (cells.back().empty()) cells.pop_back();
    return cells;
}

std::vector<double> numbers_of(std::string_view line, const Lines& lines) {
    std::vector<double> row;
    for (const auto cell : cells_of(line)) {
        const auto value = parse_real(cell);
        if (!value) lines.fail(quote(cell) + " is no number; expected a row of a pose file");
        row.push_back(*value);
    }
    return row;
}

bool are_finite(const std::vector<double>& row) {
    return std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
}

PoseRows read_pose_rows(Lines& lines, std::size_t titles) {
    RowReader reader(lines);
    bool has_commas = false;
    while (lines.next()) {
        const std::string_view line = trim(lines.line());
        if (is_blank_or_comment(line) || lines.number() == titles) continue;
        has_commas = line.find(',') != std::string_view::npos;
        reader.read(numbers_of(line, lines));
    }
    return reader.finish(has_commas);
}

}  // namespace dynamic_filter::io
