// SPDX-License-Identifier: MIT
/// Reads the beams around a vector of places from the image. Only sight_kernel.cpp includes this
/// file, once per instruction-set level.
#pragma once

#include <numbers>

#include "filter/lanes.hpp"
#include "filter/sight_kernel.hpp"

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

constexpr float kPi = std::numbers::pi_v<float>;

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
/// Cosine on [-pi/2, pi/2]; the error is below 3e-5.
DF_INLINE Floats cosine(Floats x) {
    const Floats s = x * x;
    return 1.0F + s * (-0.5F + s * (1.0F / 24.0F + s * (-1.0F / 720.0F + s * (1.0F / 40320.0F))));
}

/// A vector of places, and the distance within which beams matter to each. Lengths are in pixels
/// unless stated otherwise.
struct Places {
    Ints in_range;
    Floats range, touch;               // [m]
    Floats column_width;               // [rad] width of a column as a true arc
    Floats column, row;                // position in the image
    Floats reach_columns, reach_rows;  // half the size of the window
    Floats own_columns, own_rows;  // largest distance of a beam that belongs to the place itself
    Floats beside_rows;            // SightMargins::beside
    Floats per_reach_column, per_reach_row;
};
DF_INLINE Places places_at(const SightArgs& args, const float* azimuths, const float* elevations,
                           const float* ranges) {
    const Floats azimuth = load(azimuths), elevation = load(elevations), range = load(ranges);
    Places p;
    // Comparisons with NaN are false, so places with NaN are not judged, and no value computed from
    // NaN is used.
    p.in_range = (range >= args.nearest) & (range <= args.farthest) & (magnitude(azimuth) <= 4.0F) &
                 (magnitude(elevation) <= 2.0F);
    const Floats zero{}, one = zero + 1.0F;
    p.range = p.in_range ? range : one;
    p.touch = args.touch + args.per_metre * p.range;
    const Floats slant = larger(cosine(p.in_range ? elevation : zero), zero + 0.01F);
    p.column_width = args.azimuth_step * slant;
    p.column = ((p.in_range ? azimuth : zero) + kPi) / args.azimuth_step;
    p.row = ((p.in_range ? elevation : zero) - args.elevation_min) / args.elevation_step;
    const Floats beside = args.beside / p.range;
    const Floats beside_columns = beside / p.column_width;
    const Floats apart = larger(beside, args.apart / p.range);
    p.beside_rows = beside / args.elevation_step;
    const float around = 0.49F * static_cast<float>(args.columns - 1);
    p.reach_columns = smaller(larger(one, apart / p.column_width), zero + around);
    const Floats all_rows = zero + static_cast<float>(args.rows);
    p.reach_rows = smaller(larger(one, apart / args.elevation_step), all_rows);
    p.own_columns = larger(args.own_pixels * one, beside_columns);
    p.own_rows = larger(args.own_pixels * one, p.beside_rows);
    p.per_reach_column = 1.0F / p.reach_columns;
    p.per_reach_row = 1.0F / p.reach_rows;
    return p;
}

/// Column in the stored view; a result of `stored_columns` or more means that it is not stored.
DF_INLINE Ints stored(const SightArgs& args, Ints column) {
    // The window may begin one circle earlier, and the view may begin near the end of the circle.
    Ints from_first = column - args.first_column;
    from_first = from_first < 0 ? from_first + args.columns : from_first;
    from_first = from_first < 0 ? from_first + args.columns : from_first;
    return from_first >= args.columns ? from_first - args.columns : from_first;
}

constexpr int kMargin = 3;  // BeamImage::kMargin

/// The first pixel of each section of a row that begins at these columns. A section outside the
/// image or the view, or one that is not wanted, points to empty pixels.
DF_INLINE Ints first_pixels(const SightArgs& args, Ints row, Ints column, Ints wanted) {
    const int length = args.stored_columns + 2 * kMargin;
    const Ints place = stored(args, column);
    // Sections may begin just before the view.
    const Ints from = place < args.stored_columns ? place : place - args.columns;
    const Ints kept = wanted & (from >= -kMargin);
    return kept ? row * length + kMargin + from : Ints{} + args.rows * length;
}
DF_INLINE Ints pixels_at(const SightArgs& args, Ints first) {
    Ints pixels;
    for (int k = 0; k < kLanes; ++k) pixels[k] = static_cast<std::int32_t>(args.pixels[first[k]]);
    return pixels;
}

/// Four consecutive pixels for each place; they are read along the rows and then transposed.
struct Section {
    Ints pixels[4];
};
using Four = std::int32_t __attribute__((vector_size(16)));
/// In registers: a detour through memory would wait for its own stores.
DF_INLINE Ints joined(const Four (&four)[kLanes / 4]) {
#if DF_LANES == 4
    return four[0];
#else
    const auto low = __builtin_shufflevector(four[0], four[1], 0, 1, 2, 3, 4, 5, 6, 7);
#if DF_LANES == 8
    return low;
#else
    const auto high = __builtin_shufflevector(four[2], four[3], 0, 1, 2, 3, 4, 5, 6, 7);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#endif
#endif
}
DF_INLINE Section section_at(const SightArgs& args, Ints first) {
    Four turned[4][kLanes / 4];
    for (int k = 0; k < kLanes; k += 4) {
        Four in[4];
        for (int i = 0; i < 4; ++i) __builtin_memcpy(&in[i], args.pixels + first[k + i], 16);
        const Four low01 = __builtin_shufflevector(in[0], in[1], 0, 4, 1, 5);
        const Four low23 = __builtin_shufflevector(in[2], in[3], 0, 4, 1, 5);
        const Four high01 = __builtin_shufflevector(in[0], in[1], 2, 6, 3, 7);
        const Four high23 = __builtin_shufflevector(in[2], in[3], 2, 6, 3, 7);
        turned[0][k / 4] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
        turned[1][k / 4] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
        turned[2][k / 4] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
        turned[3][k / 4] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
    }
    Section out;
    for (int i = 0; i < 4; ++i) out.pixels[i] = joined(turned[i]);
    return out;
}

/// One beam for each place.
struct Beams {
    Ints there;  // true if the beam exists and is near enough
    Floats right, up, range;
    Ints touches, blocks;
};
DF_INLINE Beams beams_of(const SightArgs& args, const Places& p, Ints pixel, Ints row,
                         Ints column) {
    const Ints range_cm = pixel & 0xFFFF;
    const auto part = [&](int shift) {
        return (to_floats(pixel >> shift & 0xFF) + 0.5F) * (1.0F / 256.0F);
    };
    Beams b;
    b.right = to_floats(column) + part(16) - p.column;
    b.up = to_floats(row) + part(24) - p.row;
    b.range = 0.01F * to_floats(range_cm);
    const Floats columns = magnitude(b.right), rows = magnitude(b.up);
    b.there = (range_cm != 0) & (columns <= p.reach_columns) & (rows <= p.reach_rows);
    const Ints own = b.there & (columns <= p.own_columns) & (rows <= p.own_rows);
    const Floats gap = b.range - p.range;
    const Floats across = p.range * p.column_width * columns;
    const Floats along = p.range * args.elevation_step * rows;
    b.touches = own & (across * across + along * along + gap * gap <= p.touch * p.touch);
    b.blocks = own & (gap < -args.beyond) & (rows <= p.beside_rows);
    return b;
}

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
