// SPDX-License-Identifier: MIT
#include "recording/layouts/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {

std::vector<double> read_numbers(std::string_view text, const Lines& where) {
    std::vector<double> numbers;
    for (const std::string_view token : split_tokens(text)) {
        const auto value = parse_real(token);
        if (!value) where.fail(quote(token) + " is no number");
        numbers.push_back(*value);
    }
    return numbers;
}

Pose read_pose_row(std::string_view text, const Lines& where) {
    const std::vector<double> row = read_numbers(text, where);
    if (row.size() != 12) {
        where.fail(fmt::format("{} numbers; expected 12, a 3x4 matrix row by row", row.size()));
    }
    if (!std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); })) {
        return lost_pose();
    }
    return pose_from_rows(Eigen::Map<const Rows34>(row.data()), where);
}

std::optional<std::size_t> index_of(const std::filesystem::path& scan) {
    std::string digits = scan.stem().string();
    const std::size_t zeros = std::min(digits.find_first_not_of('0'), digits.size());
    if (zeros > 0) digits.erase(0, zeros == digits.size() ? zeros - 1 : zeros);
    return parse_count(digits);
}

}  // namespace dynamic_filter::io
