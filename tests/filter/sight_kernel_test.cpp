// SPDX-License-Identifier: MIT
#include "filter/sight_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "filter/line_of_sight_scalar.hpp"
#include "support/levels.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace sight_kernel_test {

const SightMargins kMargins = margins_of(ScansConfig{}.sight, Config{}.map.voxel_size);
constexpr double kDeg = std::numbers::pi / 180.0;

Point at(double azimuth, double elevation, double range) {
    return (range * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation)))
        .cast<float>();
}

/// A box of walls and a floor, with things in it, holes, and noise; `view` degrees of it.
BeamImage scan(double step, double view, test::Random& random) {
    Points points;
    for (double azimuth = 180.0 - view / 2; azimuth < 180.0 + view / 2; azimuth += step) {
        for (double elevation = -25.0; elevation <= 15.0; elevation += 2.0 * step) {
            if (random.below(12) == 0) continue;
            const double a = azimuth * kDeg, e = elevation * kDeg;
            double range = 15.0 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
            if (e < 0.0) range = std::min(range, 1.8 / -std::sin(e));
            if (std::fmod(azimuth, 40.0) < 6.0) range = std::min(range, 2.0 + azimuth / 60.0);
            points.push_back(at(a, e, range + random.uniform(-0.03, 0.03)));
        }
    }
    const auto spacing = static_cast<float>(step * kDeg);
    return BeamImage(points, {spacing, 2.0F * spacing});
}

Directions places(std::size_t count, test::Random& random) {
    Directions out;
    for (std::size_t i = 0; i < count; ++i) {
        out.azimuth.push_back(random.uniform_f(-3.1415F, 3.1415F));
        out.elevation.push_back(random.uniform_f(-0.6F, 0.4F));
        out.range.push_back(random.uniform_f(0.2F, 22.0F));
    }
    return out;
}

template <class Level>
std::vector<std::uint8_t> check_with(const Level& level, const BeamImage& image,
                                     const Directions& places, const SightMargins& m = kMargins) {
    const ImageGrid& grid = image.grid();
    std::vector<std::uint8_t> sights(places.range.size(), 7);
    level.run({image.view().pixels,
               image.view().farthest_cm,
               grid.columns,
               grid.rows,
               image.view().first_column,
               image.view().stored_columns,
               grid.azimuth_step,
               grid.elevation_step,
               grid.elevation_min,
               m.beside,
               m.beyond,
               m.touch,
               m.surface,
               m.per_metre,
               m.nearest,
               m.farthest,
               m.own_pixels,
               m.close_pixels,
               m.close_beside,
               m.same_spot,
               m.clear,
               m.clear_unseen,
               m.apart,
               places.azimuth.data(),
               places.elevation.data(),
               places.range.data(),
               places.range.size(),
               sights.data()});
    return sights;
}

TEST(SightKernel, EveryLevelAgreesWithTheScalarFormAndBitByBitWithTheOthers) {
    test::Random random(5);
    std::array<int, 15> seen{};
    struct Case {
        double step, view;
        float apart;
    };
    for (const auto& [step, view, apart] : {Case{1.0, 360.0, 0.0F},
                                            {1.0, 359.0, 0.0F},
                                            {1.0, 357.0, 0.0F},
                                            {0.3, 360.0, 0.0F},
                                            {0.3, 360.0, 0.45F},
                                            {0.5, 70.0, 0.0F},
                                            {0.5, 8.0, 0.0F}}) {
        SightMargins margins = kMargins;
        margins.apart = apart;
        const BeamImage image = scan(step, view, random);
        Directions asked = places(20001, random);  // no whole number of vectors
        if (view < 20.0) {  // what is seen lies on both sides of where the circle closes
            for (float& a : asked.azimuth) a = (a < 0.0F ? -3.1415F : 3.1415F) + 0.05F * a;
            for (float& r : asked.range) r *= 0.4F;
        }
        const auto baseline =
            check_with(DYNAMIC_FILTER_LEVELS_OF(check_lines_of_sight)[0], image, asked, margins);
        for (const auto& level : DYNAMIC_FILTER_LEVELS_OF(check_lines_of_sight)) {
            EXPECT_EQ(check_with(level, image, asked, margins), baseline) << level.name;
        }
        std::array<int, 3> kinds{};  // unknown, occupied, free, be they weak or sure
        int other = 0;               // by rounding, at the very edge of a margin
        for (std::size_t i = 0; i < baseline.size(); ++i) {
            const Sight expected = line_of_sight(
                image, {asked.azimuth[i], asked.elevation[i], asked.range[i]}, margins);
            ++seen[static_cast<std::size_t>(expected)];
            ++kinds[is_occupied(expected) ? 1U : is_free(expected) ? 2U : 0U];
            other += static_cast<std::uint8_t>(expected) != baseline[i] ? 1 : 0;
        }
        EXPECT_LE(other, 10) << step;
        for (const int count : kinds) EXPECT_GT(count, 50) << step;
    }
    for (const Sight sight : {Sight::unknown, Sight::occupied, Sight::free, Sight::weak_occupied,
                              Sight::weak_free, Sight::passed, Sight::weak_passed}) {
        EXPECT_GT(seen[static_cast<std::size_t>(sight)], 100);
    }
}

TEST(SightKernel, AWindowThatCoversEverythingStaysWithinTheImage) {
    test::Random random(7);
    const BeamImage image = scan(1.0, 360.0, random);
    SightMargins margins = kMargins;
    margins.apart = 2e7F;
    const Directions asked = places(2001, random);
    for (const auto& level : DYNAMIC_FILTER_LEVELS_OF(check_lines_of_sight)) {
        EXPECT_EQ(check_with(level, image, asked, margins).size(), 2001U) << level.name;
    }
    EXPECT_NO_FATAL_FAILURE(line_of_sight(image, {0.1F, 0.0F, 5.0F}, margins));
}

TEST(SightKernel, WhatIsNotANumberIsNotSeen) {
    test::Random random(6);
    const BeamImage image = scan(1.0, 360.0, random);
    const float nan = std::nanf("");
    const float inf = std::numeric_limits<float>::infinity();
    const Directions asked{{nan, 0, 0, inf, 0, 9}, {0, nan, 0, 0, -inf, 0}, {5, 5, nan, 5, 5, inf}};
    for (const auto& level : DYNAMIC_FILTER_LEVELS_OF(check_lines_of_sight)) {
        EXPECT_EQ(check_with(level, image, asked), std::vector<std::uint8_t>(6, 0)) << level.name;
    }
}

}  // namespace sight_kernel_test
}  // namespace dynamic_filter
