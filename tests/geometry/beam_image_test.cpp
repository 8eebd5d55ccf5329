// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/beam_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/random.hpp"

namespace dynamic_filter {
namespace {

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

}  // namespace
}  // namespace dynamic_filter
