// SPDX-License-Identifier: MIT
// This file is compiled several times, each time with its own DYNAMIC_FILTER_LEVEL and instruction
// set. It uses only builtins and raw pointers: an inline library function compiled for AVX could be
// linked into code that runs on older machines.
#include "filter/sight_kernel.hpp"

#include "filter/lanes.hpp"
#include "filter/sight_beams.hpp"

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

namespace {

constexpr float kNone = 1e30F;  // nearness if there is no beam

/// Beams relative to the places: pixels to the right and up.
struct Near {
    Floats right, up, range, nearness;
};
DF_INLINE Ints exists(const Near& beam) { return beam.nearness < kNone; }

/// On which side of the line through two returns the places lie, in a plane that contains the
/// sensor.
struct Side {
    Ints before, on;  // in front of it by more than the margin; within the margin
};
DF_INLINE Side side_of(const SightArgs& args, Floats angle_a, Floats range_a, Floats angle_b,
                       Floats range_b, Floats r, Floats margin) {
    const Floats xa = range_a * (1.0F - 0.5F * angle_a * angle_a), ya = range_a * angle_a;
    const Floats xb = range_b * (1.0F - 0.5F * angle_b * angle_b), yb = range_b * angle_b;
    const Floats dx = xb - xa, dy = yb - ya, length_sq = dx * dx + dy * dy;
    const Floats cross = -dx * ya - dy * (r - xa);
    // Negative away from the sensor.
    const Floats to_line = dx * ya - dy * xa > 0.0F ? -cross : cross;
    const Ints one_spot = length_sq < args.same_spot * args.same_spot;
    // Multiplied by the length.
    const Floats distance = one_spot ? smaller(range_a, range_b) - r : to_line;
    const Floats limit_sq = margin * margin * (one_spot ? Floats{} + 1.0F : length_sq);
    return {(distance > 0.0F) & (distance * distance > limit_sq), distance * distance <= limit_sq};
}

constexpr int kUndecided = 8;

/// A quick decision from the pooled image and one beam: most places lie behind all returns around
/// them, or are touched by the beam towards them. Gives the result of judge(), or undecided.
DF_INLINE Ints first_check(const SightArgs& args, const Places& p) {
    const Ints row = floored(p.row), column = floored(p.column);
    const Ints inside = p.in_range & (row >= 0) & (row < args.rows);
    const Ints pixels = pixels_at(args, first_pixels(args, row, column, inside));
    const Ints touched = beams_of(args, p, pixels, row, column).touches;
    constexpr float kWidest = 4.0F;  // number of columns that three reads of the pooled image cover
    const Ints covered = inside & (p.reach_rows <= 1.0F) & (p.reach_columns <= kWidest);
    Ints farthest_cm{};
    const auto pool = [&](Ints center) {
        const Ints place = stored(args, center);
        const Ints kept = covered & (place < args.stored_columns);
        const Ints index = kept & (row * args.stored_columns + place);
        for (int k = 0; k < kLanes; ++k) {
            const std::int32_t far = kept[k] & args.farthest_cm[index[k]];
            farthest_cm[k] = far > farthest_cm[k] ? far : farthest_cm[k];
        }
    };
    pool(column);
    if (any(covered & (p.reach_columns > 1.0F))) {
        const Ints aside = floored(p.reach_columns + 0.999F) - 1;
        pool(column - aside);
        pool(column + aside);
    }
    constexpr float kRounding = 0.01F;
    const Ints behind = covered & (0.01F * to_floats(farthest_cm) < p.range - p.touch - kRounding);
    const Ints outside =
        (p.row < -p.reach_rows) | (p.row > p.reach_rows + static_cast<float>(args.rows));
    return touched ? Ints{} + 1 : (behind | outside | ~p.in_range) ? Ints{} : Ints{} + kUndecided;
}

/// What the beams around the places show: the nearest beam of each quadrant, [above][right], and
/// whether any beam touches or blocks the place.
struct Around {
    Near quad[2][2];
    Near under[2];  // [right]: the next beam farther down if quad[0] has none, see look_under()
    Ints touched{}, blocked{};
};
DF_INLINE void add(Around& around, const Places& p, const Beams& b) {
    around.touched |= b.touches;
    around.blocked |= b.blocks;
    const Floats nearness =
        magnitude(b.right) * p.per_reach_column + magnitude(b.up) * p.per_reach_row;
    for (int above = 0; above < 2; ++above) {
        const Ints in_half = b.there & (above ? b.up > 0.0F : b.up <= 0.0F);
        for (int at_right = 0; at_right < 2; ++at_right) {
            Near& nearest = around.quad[above][at_right];
            const Ints closer = in_half & (at_right ? b.right > 0.0F : b.right <= 0.0F) &
                                (nearness < nearest.nearness);
            nearest = {closer ? b.right : nearest.right, closer ? b.up : nearest.up,
                       closer ? b.range : nearest.range, closer ? nearness : nearest.nearness};
        }
    }
}
DF_INLINE Around nothing_around() {
    Around around;
    const Floats zero{};
    for (auto& side : around.quad) {
        for (Near& near : side) near = {zero, zero, zero, zero + kNone};
    }
    for (Near& near : around.under) near = {zero, zero, zero, zero + kNone};
    return around;
}

/// Looks farther down where a place has a beam above it and none below, because returns were lost:
/// the ground may go on between the beam above and the next one farther down.
DF_INLINE void look_under(const SightArgs& args, const Places& p, Around& around) {
    constexpr int kRows = 4;
    const auto lacks = [&](int side) {
        return p.in_range & exists(around.quad[1][side]) & ~exists(around.quad[0][side]) &
               ~exists(around.under[side]);
    };
    const Ints row = floored(p.row), column = floored(p.column);
    for (int down = 1; down <= kRows; ++down) {
        const Ints lacking[2] = {lacks(0), lacks(1)};
        if (!any(lacking[0] | lacking[1])) return;
        const Ints r = row - down;
        const Ints in_image = (lacking[0] | lacking[1]) & (r >= 0) & (r < args.rows);
        const Section section = section_at(args, first_pixels(args, r, column - 1, in_image));
        for (int i = 0; i < 3; ++i) {
            const Beams b = beams_of(args, p, section.pixels[i], r, column + (i - 1));
            const Ints exists_below = ((section.pixels[i] & 0xFFFF) != 0) & (b.up <= 0.0F);
            const Floats nearness = magnitude(b.right);
            for (int side = 0; side < 2; ++side) {
                Near& under = around.under[side];
                const Ints closer = lacking[side] & exists_below &
                                    (side ? b.right > 0.0F : b.right <= 0.0F) &
                                    (nearness < under.nearness);
                under = {closer ? b.right : under.right, closer ? b.up : under.up,
                         closer ? b.range : under.range, closer ? nearness : under.nearness};
            }
        }
    }
}

/// The places of a vector are processed with the widest of their windows, so places with windows of
/// similar size are grouped. Most places are so far away that their window is 3 x 3 pixels: the
/// first group.
constexpr int kWindows = 6;
DF_INLINE Ints window_of(const Places& p) {
    const Floats reach = p.reach_columns;
    const Ints wide = 1 - (reach > 2.0F) - (reach > 4.0F) - (reach > 8.0F) - (reach > 16.0F);
    return ((p.reach_rows <= 1.0F) & (p.reach_columns <= 1.0F)) ? Ints{} : wide;
}
DF_INLINE Around beams_around_small(const SightArgs& args, const Places& p) {
    Around around = nothing_around();
    const Ints row = floored(p.row), column = floored(p.column);
    for (int down = -1; down <= 1; ++down) {
        const Ints r = row + down;
        const Ints in_image = p.in_range & (r >= 0) & (r < args.rows);
        const Section section = section_at(args, first_pixels(args, r, column - 1, in_image));
        for (int i = 0; i < 3; ++i) {
            add(around, p, beams_of(args, p, section.pixels[i], r, column + (i - 1)));
        }
    }
    return around;
}
DF_INLINE Around beams_around(const SightArgs& args, const Places& p) {
    Around around = nothing_around();
    Ints active = p.in_range;
    Ints first_row = floored(p.row - p.reach_rows), last_row = floored(p.row + p.reach_rows);
    first_row = first_row < 0 ? Ints{} : first_row;
    last_row = last_row >= args.rows ? Ints{} + args.rows - 1 : last_row;
    const Ints first_column = floored(p.column - p.reach_columns);
    const Ints last_column = floored(p.column + p.reach_columns);
    const int height = largest(active & (last_row - first_row));
    const int width = largest(active & (last_column - first_column));
    for (int down = 0; down <= height; ++down) {
        const Ints r = first_row + down;
        const Ints row_active = active & (r <= last_row);
        for (int along = 0; along <= width; along += 4) {
            const Ints c = first_column + along;
            const Ints wanted = row_active & (c <= last_column);
            const Section section = section_at(args, first_pixels(args, r, c, wanted));
            for (int i = 0; i < 4 && along + i <= width; ++i) {
                add(around, p, beams_of(args, p, section.pixels[i], r, c + i));
            }
        }
        active &= ~around.touched;
        if (!any(active)) break;
    }
    return around;
}

/// Decides by the surface between the nearest beams, see line_of_sight.hpp.
DF_INLINE Ints judge(const SightArgs& args, const Places& p, const Around& around) {
    const Floats zero{};
    const auto& quad = around.quad;
    const Floats range = p.range, surface = args.surface + args.per_metre * range;
    const Floats far = range + args.beyond;
    const auto is_beyond = [&](const Near& beam) { return exists(beam) & (beam.range > far); };
    // If the place is free, its beams go on behind it; those near enough went through the place
    // itself.
    const auto passes = [&](const Near& beam) {
        return exists(beam) & (magnitude(beam.up) <= p.beside_rows) &
               (magnitude(beam.right) <= p.own_columns);
    };
    Ints beams{}, any_beyond{}, on_surface{}, passed{};
    Ints all_behind = ~Ints{};
    Floats nearest = zero + kNone;
    for (int side = 0; side < 2; ++side) {
        const Near &below = quad[0][side], &above = quad[1][side];
        beams -= exists(below) + exists(above);
        nearest = smaller(nearest, smaller(exists(below) ? below.range : zero + kNone,
                                           exists(above) ? above.range : zero + kNone));
        any_beyond |= is_beyond(below) | is_beyond(above);
        passed |= passes(below) | passes(above);
        const Ints both = exists(below) & exists(above);
        const Side up_down = side_of(args, args.elevation_step * below.up, below.range,
                                     args.elevation_step * above.up, above.range, range, surface);
        on_surface |= both & up_down.on & (smaller(below.range, above.range) < range) &
                      (larger(below.range, above.range) > range);
        // Above and below the image, and at holes in it, a beam counts only if it passes very close
        // to the place.
        const Floats close = larger(args.close_beside * p.beside_rows, zero + args.close_pixels);
        const Ints passes_close = (is_beyond(below) & (magnitude(below.up) <= close)) |
                                  (is_beyond(above) & (magnitude(above.up) <= close));
        const Ints none = ~(exists(below) | exists(above));
        const Near& under = around.under[side];
        const Side ground =
            side_of(args, args.elevation_step * under.up, under.range,
                    args.elevation_step * above.up, above.range, range, zero + args.surface);
        const Ints alone = passes_close & (~exists(under) | ground.before);
        all_behind &= none | (both ? up_down.before : alone);
        const Near &left = quad[side][0], &right = quad[side][1];
        const Ints spans = exists(left) & exists(right) & (is_beyond(left) | is_beyond(right));
        const Side left_right = side_of(args, p.column_width * left.right, left.range,
                                        p.column_width * right.right, right.range, range, surface);
        all_behind &= ~spans | left_right.before;
    }
    const Ints judged = (beams >= 2) & any_beyond & ~around.blocked;
    const Ints on = judged & ~all_behind & on_surface & ~around.touched;
    const Ints free = judged & all_behind & ~around.touched;
    const Floats enough = beams == 4 ? zero + args.clear : zero + args.clear_unseen;
    const Ints weak = on | (free & (nearest - range < enough));
    return p.in_range &
           (((around.touched | on) & 1) | (free & 2) | (weak & 4) | (free & passed & 8));
}

/// Numbers of places that are collected until they fill a vector.
struct Pending {
    std::size_t index[2 * kLanes] = {};
    int count = 0;
};
/// A vector of places, filled up with places at range 0, which are not judged.
struct Group {
    float azimuth[kLanes] = {}, elevation[kLanes] = {}, range[kLanes] = {};
};
DF_INLINE void put(Group& into, int k, const SightArgs& args, std::size_t index) {
    into.azimuth[k] = args.azimuth[index];
    into.elevation[k] = args.elevation[index];
    into.range[k] = args.range[index];
}
/// Not inlined: otherwise the compiler unrolls the loops around it, and the code does not fit into
/// the instruction cache.
template <bool small>
__attribute__((noinline)) void judge_group(const SightArgs& args, Pending& w) {
    const int done = w.count < kLanes ? w.count : kLanes;
    Group places;
    for (int k = 0; k < done; ++k) put(places, k, args, w.index[k]);
    const Places p = places_at(args, places.azimuth, places.elevation, places.range);
    Around around = small ? beams_around_small(args, p) : beams_around(args, p);
    look_under(args, p, around);
    const Ints sight = judge(args, p, around);
    for (int k = 0; k < done; ++k) args.sights[w.index[k]] = static_cast<std::uint8_t>(sight[k]);
    w.count -= done;
    for (int k = 0; k < w.count; ++k) w.index[k] = w.index[k + done];
}

DF_INLINE void judge_alike(const SightArgs& args, Pending (&pending)[kWindows], int window) {
    if (window == 0) return judge_group<true>(args, pending[window]);
    judge_group<false>(args, pending[window]);
}

}  // namespace

void check_lines_of_sight(const SightArgs& args) {
    Pending pending[kWindows];
    for (std::size_t begin = 0; begin < args.count; begin += kLanes) {
        const std::size_t left = args.count - begin;
        const int count = left < kLanes ? static_cast<int>(left) : kLanes;
        const float *azimuth = args.azimuth + begin, *elevation = args.elevation + begin;
        const float* range = args.range + begin;
        Group last;
        if (count < kLanes) {
            for (int k = 0; k < count; ++k) put(last, k, args, begin + static_cast<std::size_t>(k));
            azimuth = last.azimuth;
            elevation = last.elevation;
            range = last.range;
        }
        const Places p = places_at(args, azimuth, elevation, range);
        const Ints sight = first_check(args, p);
        const Ints undecided = (sight == kUndecided) & 1, window = window_of(p);
        // Without branches, because the CPU could not predict them.
        for (int k = 0; k < count; ++k) {
            const std::size_t i = begin + static_cast<std::size_t>(k);
            args.sights[i] = static_cast<std::uint8_t>(sight[k]);
            Pending& alike = pending[window[k]];
            alike.index[alike.count] = i;
            alike.count += undecided[k];
        }
        for (int w = 0; w < kWindows; ++w) {
            if (pending[w].count >= kLanes) judge_alike(args, pending, w);
        }
    }
    for (int w = 0; w < kWindows; ++w) {
        if (pending[w].count > 0) judge_alike(args, pending, w);
    }
}

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
