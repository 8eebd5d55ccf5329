// SPDX-License-Identifier: MIT
#include <numbers>

#include "sim/city.hpp"
#include "sim/portable.hpp"
#include "sim/props.hpp"

namespace dynamic_filter::sim::city {
namespace {

using Eigen::Vector2d;

/// Adds things to one side of a block.
struct Builder {
    const Side& side;
    Random& random;
    std::vector<Fixture>& out;

    void add(std::size_t thing, const Vector2d& at, const Vector2d& axis, double scale = 1.0) {
        out.push_back({.part = {.prototype = thing, .is_still = true},
                       .placement = {standing(at, axis, pavement, scale), Kind::structure}});
    }
    std::size_t any(Thing first, int count) {
        return first + static_cast<std::size_t>(random.below(count));
    }
};

/// Bays of the next house, so that the rest can be filled, too.
int bays_of_next(int rest, Random& random) {
    const auto [least, most] = house_bays;
    if (rest <= most) return rest;
    return least + random.below(std::min(most, rest - least) - least + 1);
}

void add_houses(Builder& builder) {
    int done = 0;
    while (done < builder.side.bays) {
        const int bays = bays_of_next(builder.side.bays - done, builder.random);
        const bool corner = done == 0 || done + bays == builder.side.bays;
        const double setback = builder.random.uniform(0.0, 0.6);
        const int first = (bays - house_bays[0]) * houses_of_a_size;
        builder.add(builder.any(house, houses_of_a_size) + static_cast<std::size_t>(first),
                    builder.side.at(front + done * bay_width, front + (corner ? 0.0 : setback)),
                    builder.side.along);
        builder.out.back().part.brightness = static_cast<float>(builder.random.uniform(0.7, 1.3));
        done += bays;
    }
}

/// Something that stands at the wall of a house.
void add_at_wall(Builder& builder, double u) {
    const Vector2d at = builder.side.at(u, front - 0.5);
    switch (builder.random.below(5)) {
        case 0:
            return builder.add(bench, at, builder.side.along);
        case 1:
            return builder.add(builder.any(planter, planters), at, builder.side.along);
        case 2:
            return builder.add(bin, at, builder.side.along);
        default:
            return;
    }
}

void add_furniture(Builder& builder) {
    constexpr double from_corner = 14.0;  // the crossing is kept free
    const Side& side = builder.side;
    Random& random = builder.random;
    const double last = side.length - from_corner;
    for (const double u : row(from_corner, last, 12.0)) {
        const SinCos a = portable_sincos(random.uniform(0.0, 2.0 * std::numbers::pi));
        if (random.chance(0.85)) {
            const double size = random.uniform(0.85, 1.15);
            const auto place = side.at(u + random.uniform(-1.0, 1.0), kerb + 0.7);
            builder.add(builder.any(tree, trees), place, {a.cos, a.sin}, size);
        }
        if (u + 6.0 < last) builder.add(lamp, side.at(u + 6.0, kerb + 0.4), -side.inward);
        add_at_wall(builder, u + 3.0);
    }
    builder.add(sign, side.at(side.length - 11.0, kerb + 0.4), side.along);
}

}  // namespace

std::vector<Fixture> block_fixtures(std::uint64_t seed, const Block& block) {
    std::vector<Fixture> out;
    out.push_back(
        {.part = {.prototype = slab, .is_still = true},
         .placement = {standing(node(block.x, block.y), Vector2d::UnitX(), 0.0), Kind::ground}});
    for (int i = 0; i < 4; ++i) {
        Random random{hash(block_seed(seed, block), 0x51de, static_cast<std::uint64_t>(i))};
        const Side side = side_of(block, i);
        Builder builder{side, random, out};
        add_houses(builder);
        add_furniture(builder);
    }
    return out;
}

}  // namespace dynamic_filter::sim::city
