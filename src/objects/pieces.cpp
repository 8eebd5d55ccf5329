// SPDX-License-Identifier: MIT
#include "objects/pieces.hpp"

#include <tsl/robin_map.h>

#include <cmath>

#include "base/numbers.hpp"

namespace dynamic_filter::app {

namespace {

using Square = std::array<std::int64_t, 2>;
using Squares = tsl::robin_map<Square, std::vector<std::uint32_t>, NumbersHash>;

/// All squares that are connected with the first one, which leave `squares`; their points.
std::vector<std::uint32_t> taken(Squares& squares, const Square& first) {
    std::vector<Square> open{first};
    std::vector<std::uint32_t> points;
    while (!open.empty()) {
        const Square at = open.back();
        open.pop_back();
        const auto found = squares.find(at);
        if (found == squares.end()) continue;
        points.insert(points.end(), found->second.begin(), found->second.end());
        squares.erase(found);
        for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x) {
            for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y) open.push_back({x, y});
        }
    }
    std::sort(points.begin(), points.end());
    return points;
}

}  // namespace

Piece piece_of(std::span<const Eigen::Vector3d> places, std::vector<std::uint32_t> points) {
    Piece piece{std::move(points), {}};
    for (const std::uint32_t i : piece.points) piece.box.extend(places[i]);
    return piece;
}

std::vector<Piece> pieces_of(std::span<const Eigen::Vector3d> places, double cell) {
    const auto square_of = [&](const Eigen::Vector3d& place) {
        return Square{static_cast<std::int64_t>(std::floor(place.x() / cell)),
                      static_cast<std::int64_t>(std::floor(place.y() / cell))};
    };
    // Points that follow each other often lie in the same square: each such run is looked up once.
    std::vector<Square> runs;
    Squares squares;
    std::vector<std::uint32_t>* in_square = nullptr;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        const Square square = square_of(places[i]);
        if (runs.empty() || runs.back() != square) {
            runs.push_back(square);
            in_square = &squares[square];
        }
        in_square->push_back(i);
    }
    std::vector<Piece> pieces;
    for (const Square& square : runs) {
        if (!squares.contains(square)) continue;
        pieces.push_back(piece_of(places, taken(squares, square)));
    }
    return pieces;
}

}  // namespace dynamic_filter::app
