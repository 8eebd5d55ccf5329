// SPDX-License-Identifier: MIT
#include "filter/mirror_cells.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace dynamic_filter {

namespace {

/// Counts of a part of a plane.
struct Tally {
    int like = 0, unlike = 0, plain = 0;
    void add(const Tally& other) {
        like += other.like;
        unlike += other.unlike;
        plain += other.plain;
    }
    void add(Likeness likeness) {
        like += likeness == Likeness::like ? 1 : 0;
        unlike += likeness == Likeness::unlike ? 1 : 0;
        plain += likeness == Likeness::plain ? 1 : 0;
    }
    /// True also if nothing is known.
    [[nodiscard]] bool is_mostly_alike(double share) const {
        return like + plain >= share * (like + plain + unlike);
    }
};

/// Counts of a column of cells, also by metre behind the plane.
struct Column {
    Tally tally;
    std::array<int, static_cast<std::size_t>(kDeepInMirror) + 1> like_at{};
    void add(const Column& other) {
        tally.add(other.tally);
        for (std::size_t i = 0; i < like_at.size(); ++i) like_at[i] += other.like_at[i];
    }
    /// True if the share of places with their like is above `share`. One surface alone may have its
    /// like by chance, so most of them must not lie at one depth.
    [[nodiscard]] bool is_mirrored(double share, int least) const {
        int most = 0;
        for (std::size_t i = 1; i < like_at.size(); ++i) {
            most = std::max(most, like_at[i - 1] + like_at[i]);
        }
        return tally.like >= least && tally.like > share * (tally.like + tally.unlike) &&
               4 * most < 3 * tally.like;
    }
};

Mirror blank_mirror(const UprightPlane& plane, std::span<const Crossing> seen) {
    Mirror mirror{.plane = plane};
    mirror.lowest = seen.front().z;
    mirror.plane.from = mirror.plane.until = seen.front().along;
    float highest = mirror.lowest;
    for (const Crossing& s : seen) {
        mirror.lowest = std::min(mirror.lowest, s.z);
        highest = std::max(highest, s.z);
        mirror.plane.from = std::min(mirror.plane.from, s.along);
        mirror.plane.until = std::max(mirror.plane.until, s.along);
    }
    mirror.columns = static_cast<int>((mirror.plane.until - mirror.plane.from) / kMirrorCell) + 1;
    mirror.rows = static_cast<int>((highest - mirror.lowest) / kMirrorCell) + 1;
    mirror.reflects.assign(static_cast<std::size_t>(kMirrorAngles * mirror.rows * mirror.columns),
                           false);
    return mirror;
}

/// Sums over the cells up to two rows and columns away from each.
std::vector<Tally> around(const std::vector<Tally>& cells, const Mirror& m) {
    std::vector<Tally> sums(cells.size());
    for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
        const int column = i % m.columns, row = i / m.columns % m.rows;
        const int first = i - row * m.columns - column;  // cell of this angle
        for (int r = std::max(0, row - 2); r <= std::min(m.rows - 1, row + 2); ++r) {
            for (int c = std::max(0, column - 2); c <= std::min(m.columns - 1, column + 2); ++c) {
                sums[static_cast<std::size_t>(i)].add(
                    cells[static_cast<std::size_t>(first + r * m.columns + c)]);
            }
        }
    }
    return sums;
}

/// The columns of cells up to half a metre around each, by angle of incidence and column.
std::vector<Column> columns_of(const Mirror& m, std::span<const Crossing> seen,
                               std::span<const Likeness> likeness) {
    std::vector<Column> single(static_cast<std::size_t>(kMirrorAngles * m.columns));
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto cell = m.cell(seen[i].along, seen[i].z, seen[i].angle);
        if (!cell) continue;
        const int column = static_cast<int>(*cell) % m.columns + seen[i].angle * m.columns;
        Column& of = single[static_cast<std::size_t>(column)];
        of.tally.add(likeness[i]);
        if (likeness[i] == Likeness::like) ++of.like_at[static_cast<std::size_t>(seen[i].depth)];
    }
    std::vector<Column> sums(single.size());
    for (int i = 0; i < static_cast<int>(sums.size()); ++i) {
        for (int k = i - 2; k <= i + 2; ++k) {
            const bool is_same_angle =
                k >= 0 && k < static_cast<int>(sums.size()) && k / m.columns == i / m.columns;
            if (is_same_angle)
                sums[static_cast<std::size_t>(i)].add(single[static_cast<std::size_t>(k)]);
        }
    }
    return sums;
}

/// The floor in front of a mirror has its like behind an opening, too, so only what is seen above
/// it tells that a mirror goes down to the floor. A ceiling does not tell that it goes up.
void mark_down(Mirror& mirror, const std::vector<Tally>& near, double share) {
    for (std::size_t i = mirror.reflects.size(); i-- > 0;) {
        const auto row = static_cast<int>(i) / mirror.columns % mirror.rows;
        if (row + 1 == mirror.rows || mirror.reflects[i]) continue;
        const bool goes_on = mirror.reflects[i + static_cast<std::size_t>(mirror.columns)];
        if (goes_on && near[i].is_mostly_alike(share)) mirror.reflects[i] = true;
    }
}

/// The sums over all angles of incidence, for each of them.
std::vector<Tally> at_any_angle(const std::vector<Tally>& tallies) {
    const std::size_t cells = tallies.size() / kMirrorAngles;
    std::vector<Tally> sums(tallies.size());
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        for (std::size_t k = i % cells; k < tallies.size(); k += cells) sums[i].add(tallies[k]);
    }
    return sums;
}

/// What reflects at some angle reflects at a more grazing one, too, unless that was seen otherwise.
void mark_grazing(Mirror& mirror, const std::vector<Column>& columns) {
    const std::size_t cells = mirror.reflects.size() / kMirrorAngles;
    const auto width = static_cast<std::size_t>(mirror.columns);
    for (std::size_t i = cells; i < mirror.reflects.size(); ++i) {
        const Tally& column = columns[i / cells * width + i % width].tally;
        if (mirror.reflects[i - cells] && column.unlike <= column.like) mirror.reflects[i] = true;
    }
}

}  // namespace

MarkedMirror mark_mirror(const UprightPlane& plane, std::span<const Crossing> seen,
                         std::span<const Likeness> likeness, double share, int least) {
    MarkedMirror out{blank_mirror(plane, seen)};
    Mirror& mirror = out.mirror;
    const std::vector<Column> columns = columns_of(mirror, seen, likeness);
    const auto is_mirrored = [&](const Column& c) { return c.is_mirrored(share, least); };
    if (std::none_of(columns.begin(), columns.end(), is_mirrored)) return out;  // nearly always
    std::vector<bool> column_reflects(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) column_reflects[i] = is_mirrored(columns[i]);

    std::vector<Tally> cells(mirror.reflects.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto cell = mirror.cell(seen[i].along, seen[i].z, seen[i].angle);
        if (cell) cells[*cell].add(likeness[i]);
    }
    const std::vector<Tally> near = around(cells, mirror), near_at_any_angle = at_any_angle(near);
    const auto width = static_cast<std::size_t>(mirror.columns);
    const std::size_t of_angle = cells.size() / kMirrorAngles;
    int like = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        mirror.reflects[i] = column_reflects[i / of_angle * width + i % width] &&
                             near_at_any_angle[i].like > 0 && near[i].is_mostly_alike(share) &&
                             cells[i].is_mostly_alike(share);
        if (mirror.reflects[i]) like += cells[i].like - 4 * cells[i].unlike;
    }
    mark_down(mirror, near, share);
    mark_grazing(mirror, columns);
    out.like = std::max(like, 0);
    return out;
}

}  // namespace dynamic_filter
