// SPDX-License-Identifier: MIT
#include "recording/layouts/matrix.hpp"

#include <fmt/format.h>

#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {
namespace {

Eigen::RowVector4d read_row(const Lines& lines) {
    Eigen::RowVector4d row;
    const auto tokens = split_tokens(lines.line());
    if (tokens.size() != 4) {
        lines.fail(fmt::format("{} numbers; expected 4, a row of a 4x4 matrix", tokens.size()));
    }
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto value = parse_real(tokens[i]);
        if (!value) lines.fail(quote(tokens[i]) + " is no number");
        row[static_cast<Eigen::Index>(i)] = *value;
    }
    return row;
}

}  // namespace

Pose read_matrix(Lines& lines) {
    Eigen::Matrix4d matrix;
    int rows = 0;
    while (rows < 4 && lines.next()) {
        if (!trim(lines.line()).empty()) matrix.row(rows++) = read_row(lines);
    }
    if (rows < 4) {
        throw InputError(lines.file(), "", fmt::format("{} rows; expected a 4x4 matrix", rows));
    }
    if (!matrix.allFinite()) return lost_pose();
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) lines.fail("the last row is not 0 0 0 1");
    return pose_from_rows(matrix.topRows<3>(), lines);
}

}  // namespace dynamic_filter::io
