// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sim/city.hpp"
#include "sim/props.hpp"

namespace dynamic_filter::sim::city {
namespace {

using Eigen::Vector2d;

constexpr double parking_from = 17.0, parking_spacing = 5.8;  // [m] of the places
constexpr int most_places = 14;                               // of a side
constexpr int numbers_of_a_side = 2 * most_places + 2;        // two cars a place, and a site
static_assert(most_blocks * most_blocks * 4 * numbers_of_a_side < 65536);

std::uint64_t place_seed(std::uint64_t seed, const Block& block, int side, int place) {
    return hash(hash(block_seed(seed, block), 0x9a2c), static_cast<std::uint64_t>(side),
                static_cast<std::uint64_t>(place));
}

bool covers(const Site& site, int drive, int place) {
    return site.first_drive > 0 && drive >= site.first_drive && place >= site.first_place &&
           place < site.first_place + site.places;
}

/// The number of the first thing of a side. Blocks outside of most_blocks cannot be seen.
int first_number(const Block& block, int side) {
    const auto wrapped = [](int x) {
        return ((x + reserve) % most_blocks + most_blocks) % most_blocks;
    };
    const int of_block = wrapped(block.y) * most_blocks + wrapped(block.x);
    return (of_block * 4 + side) * numbers_of_a_side + 1;
}

bool is_there_in_all(std::uint64_t seed, const Block& block, int side, int place, const Day& day) {
    const int car = car_at(seed, block, side, place, day.drive);
    for (int drive = 1; drive <= day.drives; ++drive) {
        if (car_at(seed, block, side, place, drive) != car) return false;
    }
    return true;
}

Fixture temporary(std::size_t thing, int number, const Eigen::Affine3f& T) {
    return {.part = {.prototype = thing, .instance = static_cast<std::uint16_t>(number)},
            .placement = {T, Kind::temporary}};
}

Fixture car(std::uint64_t bits, const Side& side, int place) {
    Random random{bits};
    const bool is_van = random.chance(0.12);
    const double u = place_at(place) + (is_van ? 0.0 : random.uniform(-0.4, 0.4));
    const double v = parking + random.uniform(-0.08, 0.08);
    const auto prototype = is_van ? Prototype::van : Prototype::car;
    const double scale = is_van ? 0.9 : random.uniform(0.92, 1.06);
    const double way = random.chance(0.9) ? -1.0 : 1.0;  // few stand against the traffic
    return {.part = {.prototype = static_cast<std::size_t>(prototype),
                     .brightness = static_cast<float>(random.uniform(0.4, 1.4)),
                     .is_still = true},
            .placement = {standing(side.at(u, v), way * side.along, 0.0, scale), Kind::structure}};
}

/// A fence around the places, with pallets and barriers behind it.
void add_site(std::uint64_t bits, const Side& side, const Site& site, int number,
              std::vector<Fixture>& out) {
    constexpr double outer = 3.65, inner = 5.5;  // [m] from the middle of the street
    const double begin = place_at(site.first_place) - 0.5 * parking_spacing;
    const double end = begin + parking_spacing * site.places;
    const double panels = std::floor((end - begin) / fence_length);
    for (const double u : row(begin, begin + (panels - 0.5) * fence_length, fence_length))
        out.push_back(temporary(fence, number, standing(side.at(u, outer), side.along, 0.0)));
    for (const double u : {begin, begin + panels * fence_length}) {
        const double scale = (inner - outer) / fence_length;
        Eigen::Affine3f T = standing(side.at(u, outer), side.inward, 0.0);
        T.linear().col(0) *= static_cast<float>(scale);
        out.push_back(temporary(fence, number, T));
    }
    Random random{bits};
    for (const double u : row(begin + 1.5, begin + panels * fence_length - 1.5, 2.6)) {
        const Vector2d at = side.at(u + random.uniform(-0.3, 0.3), 4.7);
        const int what = random.below(4);
        if (what > 1) continue;
        out.push_back(temporary(what == 0 ? pallet : barrier, number,
                                standing(at, what == 0 ? side.along : side.inward, 0.0)));
        out.back().part.brightness = static_cast<float>(random.uniform(0.7, 1.6));
    }
}

}  // namespace

int places(const Side& side) {
    return std::min(most_places,
                    1 + static_cast<int>((side.length - 2.0 * parking_from) / parking_spacing));
}

double place_at(int place) { return parking_from + parking_spacing * place; }

Site site_at(std::uint64_t seed, const Block& block, int side) {
    Random random{hash(block_seed(seed, block), 0x517e, static_cast<std::uint64_t>(side))};
    if (!random.chance(0.12)) return {};
    Site site;
    site.first_drive = 2 + random.below(2);
    site.places = 3 + random.below(3);
    site.first_place = random.below(places(side_of(block, side)) - site.places + 1);
    return site;
}

int car_at(std::uint64_t seed, const Block& block, int side, int place, int drive) {
    if (covers(site_at(seed, block, side), drive, place)) return 0;
    const std::uint64_t bits = place_seed(seed, block, side, place);
    // What a place is used for, and by chance, whether a car is there that day.
    const double use = unit(hash(bits, 1));
    const double today = unit(hash(bits, 2, static_cast<std::uint64_t>(drive)));
    if (use < 0.15) return 0;                     // empty
    if (use < 0.55) return 1;                     // the same car in all drives
    if (use < 0.80) return today < 0.55 ? 1 : 0;  // one car, in some drives
    return today < 0.25 ? 0 : (today < 0.625 ? 1 : 2);
}

std::vector<Fixture> parked(std::uint64_t seed, const Block& block, const Day& day) {
    std::vector<Fixture> out;
    for (int s = 0; s < 4; ++s) {
        const Side side = side_of(block, s);
        const int first = first_number(block, s);
        for (int place = 0; place < places(side); ++place) {
            const int which = car_at(seed, block, s, place, day.drive);
            if (which == 0) continue;
            const std::uint64_t bits = place_seed(seed, block, s, place);
            Fixture fixture = car(hash(bits, 3, static_cast<std::uint64_t>(which)), side, place);
            if (!is_there_in_all(seed, block, s, place, day)) {
                fixture.part.instance = static_cast<std::uint16_t>(first + 2 * place + which - 1);
                fixture.part.is_still = false;
                fixture.placement.kind = Kind::temporary;
            }
            out.push_back(fixture);
        }
        const Site site = site_at(seed, block, s);
        if (site.first_drive > 0 && day.drive >= site.first_drive) {
            add_site(place_seed(seed, block, s, most_places), side, site, first + 2 * most_places,
                     out);
        }
    }
    return out;
}

}  // namespace dynamic_filter::sim::city
