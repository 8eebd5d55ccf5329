// SPDX-License-Identifier: MIT
#include "filter/line_of_sight_scalar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace dynamic_filter {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A beam relative to the place: angles [rad] to the right and up, both as true arcs.
struct Near {
    float right = 0.0F, up = 0.0F, range = 0.0F;
    float nearness = std::numeric_limits<float>::infinity();  // infinite: there is no beam
    [[nodiscard]] bool exists() const { return nearness < 1e9F; }
};

/// The nearest beam of each quadrant; indices: [above][right].
using Quad = std::array<std::array<Near, 2>, 2>;

/// Distance [m] of the place (range r, angle 0) in front of the line through two returns; negative
/// if it is behind the line. The returns and the place lie in a plane that contains the sensor.
float before_line(float angle_a, float range_a, float angle_b, float range_b, float r,
                  float same_spot) {
    const float xa = range_a * (1.0F - 0.5F * angle_a * angle_a), ya = range_a * angle_a;
    const float xb = range_b * (1.0F - 0.5F * angle_b * angle_b), yb = range_b * angle_b;
    const float dx = xb - xa, dy = yb - ya, length = std::sqrt(dx * dx + dy * dy);
    if (length < same_spot) return std::min(range_a, range_b) - r;
    // The side of the line on which the sensor is.
    const float side = (dx * ya - dy * xa) > 0.0F ? -1.0F : 1.0F;
    return side * (dx * (0.0F - ya) - dy * (r - xa)) / length;
}

class LineOfSight {
public:
    LineOfSight(const BeamImage& image, const Beam& place, const SightMargins& margins)
        : image_(image), grid_(image.grid()), place_(place), margins_(margins) {
        cos_elevation_ = std::max(std::cos(place.elevation), 0.01F);
        beside_ = margins.beside / place.range;
        const float column = grid_.azimuth_step * cos_elevation_;
        const float apart = std::max(margins.apart / place.range, beside_);
        reach_right_ = std::max(column, apart);
        const float all_rows = static_cast<float>(grid_.rows) * grid_.elevation_step;
        reach_up_ = std::min(std::max(grid_.elevation_step, apart), all_rows);
        own_right_ = std::max(margins.own_pixels * column, beside_);
        own_up_ = std::max(margins.own_pixels * grid_.elevation_step, beside_);
        touch_ = margins.touch + margins.per_metre * place.range;
        surface_ = margins.surface + margins.per_metre * place.range;
    }

    Sight judge() {
        if (touched()) return Sight::occupied;
        if (blocked_) return Sight::unknown;
        return between();
    }

private:
    /// Visits the beams around the place. Returns true if one of them ended at the place.
    bool touched() {
        const float row = (place_.elevation - grid_.elevation_min) / grid_.elevation_step;
        const float rows = reach_up_ / grid_.elevation_step;
        const int first_row = std::max(0, static_cast<int>(std::floor(row - rows)));
        const int last_row = std::min(grid_.rows - 1, static_cast<int>(std::floor(row + rows)));
        const float column = (place_.azimuth + kPi) / grid_.azimuth_step;
        const float columns = std::min(reach_right_ / cos_elevation_ / grid_.azimuth_step,
                                       0.49F * static_cast<float>(grid_.columns - 1));
        const int first_column = static_cast<int>(std::floor(column - columns));
        const int last_column = static_cast<int>(std::floor(column + columns));
        for (int r = first_row; r <= last_row; ++r) {
            for (int c = first_column; c <= last_column; ++c) {
                const int wrapped = c < 0                ? c + grid_.columns
                                    : c >= grid_.columns ? c - grid_.columns
                                                         : c;
                if (image_.has_beam(r, wrapped) && visit(image_.beam(r, wrapped))) return true;
            }
        }
        return false;
    }

    [[nodiscard]] Near relative(const Beam& beam) const {
        float turn = beam.azimuth - place_.azimuth;
        if (turn > kPi) turn -= 2.0F * kPi;
        if (turn < -kPi) turn += 2.0F * kPi;
        return {turn * cos_elevation_, beam.elevation - place_.elevation, beam.range, 0.0F};
    }

    bool visit(const Beam& beam) {
        Near near = relative(beam);
        const float right = std::abs(near.right), up = std::abs(near.up);
        if (right > reach_right_ || up > reach_up_) return false;
        if (right <= own_right_ && up <= own_up_) {
            const float gap = beam.range - place_.range;
            const float across_sq = place_.range * place_.range * (right * right + up * up);
            if (across_sq + gap * gap <= touch_ * touch_) return true;
            blocked_ |= gap < -margins_.beyond && up <= beside_;
        }
        near.nearness = right / reach_right_ + up / reach_up_;
        Near& nearest = quad_[near.up > 0.0F][near.right > 0.0F];
        if (near.nearness < nearest.nearness) nearest = near;
        return false;
    }

    [[nodiscard]] bool is_beyond(const Near& beam) const {
        return beam.exists() && beam.range > place_.range + margins_.beyond;
    }

    /// Decides by the surface between the nearest beams.
    [[nodiscard]] Sight between() const {
        int beams = 0;
        bool any_beyond = false, all_behind = true, on_surface = false, passed = false;
        float nearest = std::numeric_limits<float>::infinity();
        for (const auto& row : quad_) {
            for (const Near& beam : row) {
                beams += beam.exists() ? 1 : 0;
                if (beam.exists()) nearest = std::min(nearest, beam.range);
                any_beyond |= is_beyond(beam);
                passed |= beam.exists() && std::abs(beam.up) <= beside_ &&
                          std::abs(beam.right) <= own_right_;
            }
        }
        if (beams < 2 || !any_beyond) return Sight::unknown;
        for (int side = 0; side < 2; ++side) {
            const auto s = static_cast<std::size_t>(side);
            const Near &below = quad_[0][s], &above = quad_[1][s];
            if (below.exists() && above.exists()) {
                const float before = before_line(below.up, below.range, above.up, above.range,
                                                 place_.range, margins_.same_spot);
                all_behind &= before > surface_;
                on_surface |= std::abs(before) <= surface_ &&
                              std::min(below.range, above.range) < place_.range &&
                              std::max(below.range, above.range) > place_.range;
            } else if (below.exists() || above.exists()) {
                all_behind &= passes_close(below.exists() ? below : above);
                all_behind &= below.exists() || is_before_ground(s, above);
            }
            const Near &left = quad_[s][0], &right = quad_[s][1];
            if (left.exists() && right.exists() && (is_beyond(left) || is_beyond(right))) {
                all_behind &= before_line(left.right, left.range, right.right, right.range,
                                          place_.range, margins_.same_spot) > surface_;
            }
        }
        if (!all_behind) return on_surface ? Sight::weak_occupied : Sight::unknown;
        const float enough = beams == 4 ? margins_.clear : margins_.clear_unseen;
        const bool sure = nearest - place_.range >= enough;
        if (passed) return sure ? Sight::passed : Sight::weak_passed;
        return sure ? Sight::free : Sight::weak_free;
    }

    /// False if the place lies on the surface that goes on between the beam above it and the next
    /// beam farther down than its neighbors, whose returns were lost.
    [[nodiscard]] bool is_before_ground(std::size_t side, const Near& above) const {
        const auto under = farther_down(side);
        return !under || before_line(under->up, under->range, above.up, above.range, place_.range,
                                     margins_.same_spot) > margins_.surface;
    }
    /// The nearest beam of the next row below the place that has one on that side.
    [[nodiscard]] std::optional<Near> farther_down(std::size_t side) const {
        constexpr int kRows = 4;
        const float row = (place_.elevation - grid_.elevation_min) / grid_.elevation_step;
        const float column = (place_.azimuth + kPi) / grid_.azimuth_step;
        const int own_row = static_cast<int>(std::floor(row));
        const int own_column = static_cast<int>(std::floor(column));
        for (int r = own_row - 1; r >= std::max(own_row - kRows, 0); --r) {
            if (r >= grid_.rows) continue;
            std::optional<Near> nearest;
            for (int c = own_column - 1; c <= own_column + 1; ++c) {
                const int wrapped = (c + grid_.columns) % grid_.columns;
                if (!image_.has_beam(r, wrapped)) continue;
                const Near near = relative(image_.beam(r, wrapped));
                if (near.up > 0.0F || (near.right > 0.0F) != (side == 1)) continue;
                if (!nearest || std::abs(near.right) < std::abs(nearest->right)) nearest = near;
            }
            if (nearest) return nearest;
        }
        return std::nullopt;
    }

    /// Above and below the image, and at holes in it, a beam counts only if it passes very close to
    /// the place.
    [[nodiscard]] bool passes_close(const Near& beam) const {
        return is_beyond(beam) &&
               std::abs(beam.up) <= std::max(margins_.close_beside * beside_,
                                             margins_.close_pixels * grid_.elevation_step);
    }

    const BeamImage& image_;
    const ImageGrid& grid_;
    const Beam& place_;
    const SightMargins& margins_;
    float cos_elevation_, beside_, reach_right_, reach_up_, own_right_, own_up_, touch_, surface_;
    bool blocked_ = false;
    Quad quad_{};
};

}  // namespace

Sight line_of_sight(const BeamImage& image, const Beam& place, const SightMargins& margins) {
    if (!(place.range >= margins.nearest && place.range <= margins.farthest)) return Sight::unknown;
    return LineOfSight(image, place, margins).judge();
}

}  // namespace dynamic_filter
