// SPDX-License-Identifier: MIT
#include "geometry/beam_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/random.hpp"

namespace dynamic_filter {
namespace beam_image_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kDeg = std::numbers::pi / 180.0;

Point polar(double azimuth_deg, double elevation_deg, double range) {
    const double a = azimuth_deg * kDeg, e = elevation_deg * kDeg;
    return (range *
            Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)))
        .cast<float>();
}

BeamPattern spacing(double degrees) {
    const auto step = static_cast<float>(degrees * kDeg);
    return {step, step};
}

std::vector<Beam> beams_of(const BeamImage& image) {
    std::vector<Beam> beams;
    for (int r = 0; r < image.grid().rows; ++r) {
        for (int c = 0; c < image.grid().columns; ++c) {
            if (image.has_beam(r, c)) beams.push_back(image.beam(r, c));
        }
    }
    return beams;
}

TEST(ToSpherical, AgreesWithTheLibraryFunctions) {
    test::Random random(1);
    const Points points = random.points(5000, 40.0);
    Pose pose = Pose::Identity();
    pose.translate(Eigen::Vector3d(1.0, -2.0, 0.5));
    pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
    Directions seen;
    to_spherical(points, pose.cast<float>(), seen);
    ASSERT_EQ(seen.range.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d p = pose * points[i].cast<double>();
        const double across = std::hypot(p.x(), p.y());
        if (across < 0.1) continue;
        EXPECT_NEAR(seen.azimuth[i], std::atan2(p.y(), p.x()), 1e-4 / across + 3e-5);
        EXPECT_NEAR(seen.elevation[i], std::atan2(p.z(), across), 3e-5);
        EXPECT_NEAR(seen.range[i], p.norm(), 1e-4);
    }
}

TEST(BeamImage, KeepsWhereEveryBeamWent) {
    test::Random random(2);
    for (int i = 0; i < 500; ++i) {
        const double azimuth = random.uniform(-179.9, 179.9), elevation = random.uniform(-80, 80);
        const double range = random.uniform(0.5, 200.0);
        const BeamImage image(Points{polar(azimuth, elevation, range)}, spacing(1.0));
        const auto beams = beams_of(image);
        ASSERT_EQ(beams.size(), 1U);
        const double part = kDeg / 256.0;
        EXPECT_NEAR(beams[0].azimuth, azimuth * kDeg, part);
        EXPECT_NEAR(beams[0].elevation, elevation * kDeg, part);
        EXPECT_NEAR(beams[0].range, range, 0.006);
    }
}

TEST(BeamImage, KeepsTheNearestBeamOfAPixel) {
    for (const auto& ranges : {std::pair{4.0, 9.0}, std::pair{9.0, 4.0}}) {
        const BeamImage image(
            Points{polar(10.2, 0.0, ranges.first), polar(10.3, 0.0, ranges.second)}, spacing(2.0));
        const auto beams = beams_of(image);
        ASSERT_EQ(beams.size(), 1U);
        EXPECT_NEAR(beams[0].range, 4.0, 0.006);
    }
}

TEST(BeamImage, BeamsApartByTheSpacingStayApart) {
    Points points;
    for (int c = 0; c < 360; ++c) points.push_back(polar(c + 0.5, 0.0, 5.0));
    EXPECT_EQ(beams_of(BeamImage(points, spacing(1.0))).size(), 360U);
}

TEST(BeamImage, LeavesOutWhatIsNoMeasurement) {
    const Points points{{0, 0, 0},     {kNan, 1, 1}, {kInf, 0, 0},
                        {1, -kInf, 0}, {700, 0, 0},  {5, 0, 0}};
    const auto beams = beams_of(BeamImage(points, spacing(1.0)));
    ASSERT_EQ(beams.size(), 1U);
    EXPECT_NEAR(beams[0].range, 5.0, 0.006);
    EXPECT_TRUE(beams_of(BeamImage(Points{}, spacing(1.0))).empty());
}

TEST(BeamImage, UnknownOrTinySpacingGivesAnImageOfBearableSize) {
    const Points points{polar(0, -45, 5), polar(0, 45, 5)};
    EXPECT_EQ(BeamImage(points, BeamPattern{}).grid().columns, 360);
    EXPECT_LE(BeamImage(points, spacing(0.001)).grid().columns, 3600);
}

TEST(BeamImage, KeepsPixelsForTheFieldOfViewOnly) {
    for (const double ahead : {0.0, 90.0, 180.0, -100.0}) {  // across the seam, too
        Points points;
        for (int c = 0; c < 70; ++c) {
            for (int r = -5; r <= 5; ++r) points.push_back(polar(ahead - 34.6 + c, r, 8.0));
        }
        const BeamImage image(points, spacing(1.0));
        EXPECT_EQ(beams_of(image).size(), points.size());
        EXPECT_GE(image.bytes(), 6 * points.size());
        EXPECT_LE(image.bytes(), 6 * points.size() * 13 / 10);
    }
}

TEST(BeamImage, CoverageIsTheShareOfPixelsWithABeam) {
    EXPECT_EQ(BeamImage().coverage(), 0.0F);
    Points all, half;
    for (int column = 0; column < 360; ++column) {
        for (int row = -5; row <= 5; ++row) {
            all.push_back(polar(column + 0.5, row, 10.0));
            if (column % 2 == 0) half.push_back(all.back());
        }
    }
    const auto step = static_cast<float>(kDeg);
    const float full = BeamImage(all, {step, step}).coverage();
    EXPECT_GT(full, 0.8F);
    EXPECT_LE(full, 1.0F);
    EXPECT_NEAR(BeamImage(half, {step, step}).coverage(), 0.5F * full, 0.02F);
}

/// The beam of a pixel as it is stored, 0 if there is none; columns wrap around the circle.
std::uint32_t stored(const BeamImage& image, int row, int column) {
    const BeamImage::View view = image.view();
    const int columns = image.grid().columns;
    const int at = (column - view.first_column + 2 * columns) % columns;
    if (at >= view.stored_columns) return 0;
    return view
        .pixels[row * (view.stored_columns + 2 * BeamImage::kMargin) + BeamImage::kMargin + at];
}
int range_cm(const BeamImage& image, int row, int column) {
    if (row < 0 || row >= image.grid().rows) return 0;
    return static_cast<int>(stored(image, row, column) & 0xFFFFU);
}

/// Scattered returns: everywhere, in one direction only, across the seam, and with narrow gaps.
std::vector<BeamImage> images() {
    test::Random random(3);
    std::vector<BeamImage> images;
    for (const auto& [from, to] : {std::pair{-180.0, 180.0}, {-60.0, 40.0}, {150.0, 230.0}}) {
        for (const std::size_t count : {3U, 60U, 3000U}) {
            Points points;
            for (std::size_t i = 0; i < count; ++i) {
                const double azimuth = random.uniform(from, to);
                const double elevation = random.uniform(-20.0, 30.0);
                points.push_back(polar(azimuth, elevation, random.uniform(0.5, 90.0)));
            }
            // The nearest first: a tile keeps the range of a beam that a nearer one replaces.
            std::sort(points.begin(), points.end(),
                      [](const Point& a, const Point& b) { return a.norm() < b.norm(); });
            images.emplace_back(points, spacing(3.0));
        }
    }
    return images;
}

TEST(BeamImage, MarginsRepeatThePixelsThatFollowOnTheCircle) {
    for (const BeamImage& image : images()) {
        const BeamImage::View view = image.view();
        const int margin = BeamImage::kMargin, length = view.stored_columns + 2 * margin;
        for (int row = 0; row < image.grid().rows; ++row) {
            for (int i = 0; i < length; ++i) {
                ASSERT_EQ(view.pixels[row * length + i],
                          stored(image, row, view.first_column + i - margin))
                    << row << ' ' << i << " of " << view.stored_columns;
            }
        }
        for (int i = 0; i <= margin; ++i) {
            EXPECT_EQ(view.pixels[image.grid().rows * length + i], 0U);
        }
    }
}

TEST(BeamImage, KnowsTheFarthestRangeOfEachPixelAndTheEightAroundIt) {
    for (const BeamImage& image : images()) {
        const BeamImage::View view = image.view();
        for (int row = 0; row < image.grid().rows; ++row) {
            for (int i = 0; i < view.stored_columns; ++i) {
                int farthest = 0;
                for (const int r : {row - 1, row, row + 1}) {
                    for (const int c : {i - 1, i, i + 1}) {
                        farthest = std::max(farthest, range_cm(image, r, view.first_column + c));
                    }
                }
                ASSERT_EQ(view.farthest_cm[row * view.stored_columns + i], farthest);
            }
        }
    }
}

TEST(BeamImage, TheFieldOfViewIsTheCircleWithoutItsWidestGap) {
    for (const BeamImage& image : images()) {
        const BeamImage::View view = image.view();
        const int columns = image.grid().columns;
        std::vector<bool> hit(static_cast<std::size_t>(2 * columns));
        for (const int turn : {0, columns}) {
            for (int c = 0; c < columns; ++c) {
                for (int r = 0; r < image.grid().rows; ++r) {
                    if (image.has_beam(r, c)) hit[static_cast<std::size_t>(turn + c)] = true;
                }
            }
        }
        int widest = 0, gap = 0;
        for (const bool is_hit : hit) {
            gap = is_hit ? 0 : gap + 1;
            widest = std::max(widest, gap);
        }
        // One empty column is kept on each side of the view.
        ASSERT_EQ(view.stored_columns, widest < 2 ? columns : columns - widest + 2);
        if (widest < 2) continue;
        EXPECT_FALSE(hit[static_cast<std::size_t>(view.first_column)]);
        EXPECT_TRUE(hit[static_cast<std::size_t>(view.first_column + 1)]);
        EXPECT_TRUE(hit[static_cast<std::size_t>(view.first_column + view.stored_columns - 2)]);
    }
}

/// True if a beam of at least `least` centimetres lies in a tile of 8 by 8 pixels that the window
/// touches.
bool reaches_by_tiles(const BeamImage& image, int least, int first_row, int last_row,
                      int first_column, int last_column) {
    const int columns = image.grid().columns;
    for (int r = 0; r < image.grid().rows; ++r) {
        if (r / 8 < first_row / 8 || r / 8 > last_row / 8) continue;
        for (int c = 0; c < columns; ++c) {
            const int range = range_cm(image, r, c);
            if (range == 0 || range < least) continue;
            for (int column = first_column; column <= last_column; ++column) {
                if ((column + columns) % columns / 8 == c / 8) return true;
            }
        }
    }
    return false;
}

TEST(BeamImage, ReachesComparesTheTilesThatTheWindowTouches) {
    test::Random random(4);
    int reached = 0, asked = 0;
    for (const BeamImage& image : images()) {
        const int columns = image.grid().columns, rows = image.grid().rows;
        const auto below = [&](int count) {
            return static_cast<int>(random.below(static_cast<std::size_t>(count)));
        };
        for (int i = 0; i < 2000; ++i, ++asked) {
            const int first_row = below(rows), last_row = first_row + below(rows - first_row);
            const int first_column = below(columns + columns / 2) - columns / 2;
            const int last_column =
                std::min(first_column + below(i % 4 == 0 ? columns + 9 : 12), columns + 40);
            if (first_column > last_column || last_column < 0) continue;
            // Half a centimetre more than a beam or a random length, so that rounding decides.
            const int known = range_cm(image, below(rows), below(columns));
            const int least = i % 2 == 0 && known > 0 ? known + below(2) : 1 + below(9500);
            const float range = 0.01F * static_cast<float>(least) + 0.005F;
            const bool expected = reaches_by_tiles(image, least, first_row, last_row,
                                                   std::max(first_column, -columns), last_column);
            ASSERT_EQ(image.reaches(range, first_row, last_row, first_column, last_column),
                      expected)
                << first_column << ".." << last_column << " of " << columns;
            reached += expected ? 1 : 0;
        }
    }
    EXPECT_GT(reached, asked / 10);
    EXPECT_LT(reached, asked * 9 / 10);
}

TEST(BeamImage, TheLimitsOfRangesAndSteps) {
    const auto count = [](double range) {
        return beams_of(BeamImage(Points{polar(0, 0, range)}, spacing(1.0))).size();
    };
    EXPECT_EQ(count(0.004), 0U);
    EXPECT_EQ(count(0.006), 1U);
    EXPECT_EQ(count(655.3), 1U);
    EXPECT_EQ(count(655.4), 0U);
    const Points points{polar(0, -45, 5), polar(0, 45, 5)};
    EXPECT_EQ(BeamImage(points, spacing(0.01)).grid().columns, 3600);
    EXPECT_EQ(BeamImage(points, spacing(90.0)).grid().columns, 120);
}

}  // namespace beam_image_test
}  // namespace dynamic_filter
