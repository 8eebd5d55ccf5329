// SPDX-License-Identifier: MIT
// Compiled several times, each with its own DYNAMIC_FILTER_LEVEL and instruction set. Only builtins
// and raw pointers here: an inline library function compiled for AVX could be linked into code that
// runs on older machines.
#include "sight_kernel.hpp"

#include "lanes.hpp"

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

namespace {

constexpr float kPi = 3.14159265358979F;
constexpr float kNone = 1e30F;  // nearness where there is no beam

DF_INLINE Ints floored(Floats v) {
    const Ints whole = __builtin_convertvector(v, Ints);
    return to_floats(whole) > v ? whole - 1 : whole;
}
DF_INLINE bool any(Ints mask) {
    std::int32_t some = 0;
    for (int k = 0; k < kLanes; ++k) some |= mask[k];
    return some != 0;
}
DF_INLINE int largest(Ints v) {
    std::int32_t most = v[0];
    for (int k = 1; k < kLanes; ++k) most = v[k] > most ? v[k] : most;
    return most;
}
/// On [-pi/2, pi/2]; error below 3e-5.
DF_INLINE Floats cosine(Floats x) {
    const Floats s = x * x;
    return 1.0F + s * (-0.5F + s * (1.0F / 24.0F + s * (-1.0F / 720.0F + s * (1.0F / 40320.0F))));
}

/// Beams as seen from the places: angles [rad] to the right and up, both true arcs.
struct Near {
    Floats right, up, range, nearness;
};
DF_INLINE Ints exists(const Near& beam) { return beam.nearness < kNone; }

/// How the places lie to the lines through two returns, in a plane that holds the sensor.
struct Side {
    Ints before, on;  // by more than the margin; within it
};
DF_INLINE Side side_of(Floats angle_a, Floats range_a, Floats angle_b, Floats range_b, Floats r,
                       Floats margin) {
    const Floats xa = range_a * (1.0F - 0.5F * angle_a * angle_a), ya = range_a * angle_a;
    const Floats xb = range_b * (1.0F - 0.5F * angle_b * angle_b), yb = range_b * angle_b;
    const Floats dx = xb - xa, dy = yb - ya, length_sq = dx * dx + dy * dy;
    const Floats cross = -dx * ya - dy * (r - xa);
    const Floats to_line = dx * ya - dy * xa > 0.0F ? -cross : cross;  // away from the sensor: -
    const Ints one_spot = length_sq < 0.02F * 0.02F;
    const Floats distance = one_spot ? smaller(range_a, range_b) - r : to_line;  // times length
    const Floats limit_sq = margin * margin * (one_spot ? Floats{} + 1.0F : length_sq);
    return {(distance > 0.0F) & (distance * distance > limit_sq), distance * distance <= limit_sq};
}

DF_INLINE Floats load(const float* values, std::size_t begin, std::size_t count) {
    Floats out;
    for (int k = 0; k < kLanes; ++k) {
        const std::size_t i = begin + static_cast<std::size_t>(k);
        out[k] = values[i < count ? i : count - 1];
    }
    return out;
}

/// See look() in line_of_sight.hpp.
DF_INLINE Ints judge(const LookArgs& args, Floats true_azimuth, Floats true_elevation,
                     Floats true_range) {
    // Comparisons with NaN are false: what is not a number is not judged, nor anything made of it.
    const Ints in_range = (true_range >= args.nearest) & (true_range <= args.farthest) &
                          (magnitude(true_azimuth) <= 4.0F) & (magnitude(true_elevation) <= 2.0F);
    Ints active = in_range;
    const Floats zero{};
    const Floats azimuth = active ? true_azimuth : zero, elevation = active ? true_elevation : zero;
    const Floats range = active ? true_range : zero + 1.0F;
    const Floats slant = larger(cosine(elevation), zero + 0.01F);
    const Floats beside = args.beside / range;
    const Floats column_width = args.azimuth_step * slant;
    const Floats reach_right = larger(1.05F * column_width, beside);
    const Floats own_right = larger(0.55F * column_width, beside);
    const Floats reach_up = larger(zero + 1.05F * args.elevation_step, beside);
    const Floats own_up = larger(zero + 0.55F * args.elevation_step, beside);
    const Floats touch = args.touch + args.per_metre * range;
    const Floats surface = args.surface + args.per_metre * range;

    const Floats row = (elevation - args.elevation_min) / args.elevation_step;
    const Floats rows = reach_up / args.elevation_step;
    Ints first_row = floored(row - rows), last_row = floored(row + rows);
    first_row = first_row < 0 ? Ints{} : first_row;
    last_row = last_row >= args.rows ? Ints{} + args.rows - 1 : last_row;
    const Floats column = (azimuth + kPi) / args.azimuth_step;
    const Floats columns =
        smaller(reach_right / column_width, zero + 0.49F * static_cast<float>(args.columns - 1));
    const Ints first_column = floored(column - columns), last_column = floored(column + columns);

    Near quad[2][2];  // the nearest beam of each quadrant: [above][right]
    for (auto& side : quad) {
        for (Near& near : side) near = {zero, zero, zero, zero + kNone};
    }
    Ints touched{}, blocked{};
    const int height = largest(active & (last_row - first_row));
    const int width = largest(active & (last_column - first_column));
    for (int down = 0; down <= height; ++down) {
        const Ints r = first_row + down;
        const Ints row_active = active & (r <= last_row);
        for (int along = 0; along <= width; ++along) {
            const Ints c = first_column + along;
            const Ints wrapped = c < 0               ? c + args.columns
                                 : c >= args.columns ? c - args.columns
                                                     : c;
            const Ints stored = wrapped < args.first_column
                                    ? wrapped - args.first_column + args.columns
                                    : wrapped - args.first_column;
            const Ints there = row_active & (c <= last_column) & (stored < args.stored_columns);
            const Ints index = there & (r * args.stored_columns + stored);
            Ints pixel;
            for (int k = 0; k < kLanes; ++k) {
                pixel[k] = static_cast<std::int32_t>(args.pixels[index[k]]);
            }
            const Ints range_cm = pixel & 0xFFFF;
            const Ints column_part = pixel >> 16 & 0xFF, row_part = pixel >> 24 & 0xFF;
            const Floats beam_range = 0.01F * to_floats(range_cm);
            const Floats beam_azimuth =
                -kPi + (to_floats(wrapped) + (to_floats(column_part) + 0.5F) * (1.0F / 256.0F)) *
                           args.azimuth_step;
            const Floats beam_elevation =
                args.elevation_min +
                (to_floats(r) + (to_floats(row_part) + 0.5F) * (1.0F / 256.0F)) *
                    args.elevation_step;
            Floats turn = beam_azimuth - azimuth;
            turn = turn > kPi ? turn - 2.0F * kPi : turn < -kPi ? turn + 2.0F * kPi : turn;
            const Floats to_right = turn * slant, to_up = beam_elevation - elevation;
            const Floats right = magnitude(to_right), up = magnitude(to_up);
            const Ints near = there & (range_cm != 0) & (right <= reach_right) & (up <= reach_up);
            const Ints own = near & (right <= own_right) & (up <= own_up);
            const Floats gap = beam_range - range;
            const Floats across_sq = range * range * (right * right + up * up);
            touched |= own & (across_sq + gap * gap <= touch * touch);
            blocked |= own & (gap < -args.beyond) & (up <= beside);
            const Floats nearness = right / reach_right + up / reach_up;
            for (int above = 0; above < 2; ++above) {
                const Ints in_half = near & (above ? to_up > 0.0F : to_up <= 0.0F);
                for (int at_right = 0; at_right < 2; ++at_right) {
                    Near& nearest = quad[above][at_right];
                    const Ints closer = in_half & (at_right ? to_right > 0.0F : to_right <= 0.0F) &
                                        (nearness < nearest.nearness);
                    nearest = {closer ? to_right : nearest.right, closer ? to_up : nearest.up,
                               closer ? beam_range : nearest.range,
                               closer ? nearness : nearest.nearness};
                }
            }
        }
        active &= ~touched;
        if (!any(active)) break;
    }

    // The surface between the nearest beams.
    const Floats far = range + args.beyond;
    const auto is_beyond = [&](const Near& beam) { return exists(beam) & (beam.range > far); };
    Ints beams{}, any_beyond{}, on_surface{};
    Ints all_behind = ~Ints{};
    for (int side = 0; side < 2; ++side) {
        const Near &below = quad[0][side], &above = quad[1][side];
        beams -= exists(below) + exists(above);
        any_beyond |= is_beyond(below) | is_beyond(above);
        const Ints both = exists(below) & exists(above);
        const Side up_down = side_of(below.up, below.range, above.up, above.range, range, surface);
        on_surface |= both & up_down.on & (smaller(below.range, above.range) < range) &
                      (larger(below.range, above.range) > range);
        // Above or below the image's border, or a hole in it, only a beam that all but meets the
        // place counts.
        const Floats close = larger(0.5F * beside, zero + 0.3F * args.elevation_step);
        const Ints passes_close = (is_beyond(below) & (magnitude(below.up) <= close)) |
                                  (is_beyond(above) & (magnitude(above.up) <= close));
        const Ints none = ~(exists(below) | exists(above));
        all_behind &= none | (both ? up_down.before : passes_close);
        const Near &left = quad[side][0], &right = quad[side][1];
        const Ints spans = exists(left) & exists(right) & (is_beyond(left) | is_beyond(right));
        const Side left_right =
            side_of(left.right, left.range, right.right, right.range, range, surface);
        all_behind &= ~spans | left_right.before;
    }
    const Ints judged = (beams >= 2) & any_beyond & ~blocked;
    const Ints occupied = touched | (judged & ~all_behind & on_surface);
    const Ints passed = judged & all_behind & ~touched;
    return in_range & ((occupied & 1) | (passed & 2));
}

}  // namespace

void look(const LookArgs& args) {
    for (std::size_t begin = 0; begin < args.count; begin += kLanes) {
        const Ints sight =
            judge(args, load(args.azimuth, begin, args.count),
                  load(args.elevation, begin, args.count), load(args.range, begin, args.count));
        for (std::size_t k = 0; k < kLanes && begin + k < args.count; ++k) {
            args.sights[begin + k] = static_cast<std::uint8_t>(sight[k]);
        }
    }
}

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
