// SPDX-License-Identifier: MIT
#include "check/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "check/scan_input.hpp"
#include "dynamic_filter/parallel.hpp"
#include "tracking/scan_sample.hpp"

namespace dynamic_filter::io {

Piece read_piece(const Recording& recording, std::size_t first, std::size_t in_a_row) {
    Piece piece;
    for (std::size_t i = first; i < std::min(recording.size(), first + in_a_row); ++i) {
        if (auto scan = read_scan(recording, i)) piece.push_back(*std::move(scan));
    }
    return piece;
}

std::vector<std::size_t> first_scans(std::size_t scans, std::size_t most, std::size_t in_a_row) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    std::vector<std::size_t> first;
    const std::size_t places = std::clamp<std::size_t>(scans / (2 * in_a_row), 1, most);
    const auto room = static_cast<double>(scans > in_a_row ? scans - in_a_row : 0);
    for (std::size_t k = 0; k < places; ++k) {
        const double whole = 0.5 + static_cast<double>(k) * kGoldenRatio;
        first.push_back(static_cast<std::size_t>((whole - std::floor(whole)) * room));
    }
    return first;
}

std::vector<Piece> read_pieces(const Recording& recording, std::size_t most, std::size_t in_a_row) {
    const std::vector<std::size_t> first = first_scans(recording.size(), most, in_a_row);
    std::vector<Piece> pieces(first.size());
    parallel_for(first.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            pieces[k] = read_piece(recording, first[k], in_a_row);
        }
    });
    std::erase_if(pieces, [](const Piece& piece) { return piece.size() < 2; });
    return pieces;
}

Twist velocity_at(const Recording& recording, std::size_t i) {
    const Info& info = recording.info();
    const std::size_t from = i == 0 ? 0 : i - 1, to = std::min(i + 1, recording.size() - 1);
    const double passed = info.stamps[to] - info.stamps[from];
    if (!(passed > 0.0)) return Twist::Zero();
    const Pose way = info.T_world_sensor[from].inverse() * info.T_world_sensor[to];
    if (!way.matrix().allFinite()) return Twist::Zero();  // one of them was lost
    return log(way) / passed;
}

std::vector<Pose> given_poses(const Piece& piece) {
    std::vector<Pose> poses;
    for (const Scan& scan : piece) poses.push_back(scan.T_world_sensor);
    return poses;
}

Piece thinned_piece(const Piece& piece, const OdometryConfig& config) {
    Piece thin;
    for (const Scan& scan : piece) thin.push_back(thinned_scan(scan, config));
    return thin;
}

}  // namespace dynamic_filter::io
