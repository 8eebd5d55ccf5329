// SPDX-License-Identifier: MIT
#include "check/pose_fit.hpp"

#include <gtest/gtest.h>

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace pose_fit_test {

PoseFit fit(double share, double blur) { return {{share, share, 0.0, 0.0}, blur}; }

TEST(PoseFit, MoreStructuresOrAsManyMoreSharplyAreBetter) {
    EXPECT_TRUE(is_better(fit(0.7, 0.05), fit(0.5, 0.05)));
    EXPECT_TRUE(is_better(fit(0.7, 0.05), fit(0.7, 0.06)));
    EXPECT_FALSE(is_better(fit(0.7, 0.05), fit(0.7, 0.05)));
    // What stands still looks sharp, but explains less.
    EXPECT_FALSE(is_better(fit(0.5, 0.04), fit(0.7, 0.05)));
}

TEST(PoseFit, TheMeanLeavesOutSeparationsThatAreNotThere) {
    EXPECT_DOUBLE_EQ(fit(0.6, 0.1).mean_overlay(), 0.6);
    EXPECT_EQ(PoseFit{}.mean_overlay(), 0.0);
    EXPECT_EQ(to_text(fit(0.6, 0.123)), "60, 60 % (1, 5 scans apart), blur 12.3 cm");
}

TEST(PoseFit, OfTwoNeitherOrOneIsBetter) {
    for (const double share : {0.0, 0.3, 0.5, 0.52, 0.7}) {
        for (const double blur : {0.05, 0.051, 0.06, 0.2}) {
            const PoseFit a = fit(share, blur), b = fit(0.5, 0.052);
            EXPECT_FALSE(is_better(a, b) && is_better(b, a)) << share << " " << blur;
        }
    }
}

TEST(PoseFit, IsBestAtTheTruePoses) {
    const auto& drive = street(false);
    const std::vector<Pose> still(drive.truth.size(), Pose::Identity());
    const std::vector<Points> upright = upright_of(drive.scans);
    const PoseFit at_truth = fit_of(drive.scans, upright, drive.truth, {});
    const PoseFit at_rest = fit_of(drive.scans, upright, still, {});
    EXPECT_TRUE(is_better(at_truth, at_rest));
    EXPECT_FALSE(is_better(at_rest, at_truth));
    for (const double share : at_truth.overlay) EXPECT_GT(share, 0.2);
    EXPECT_LT(at_truth.blur, 0.15);
}

TEST(PoseFit, OfFewScansHasOnlyTheSeparationsThatAreThere) {
    const auto& drive = street(false);
    const std::span<const Scan> scans = std::span(drive.scans).first(6);
    const PoseFit few = fit_of(scans, upright_of(scans), std::span(drive.truth).first(6), {});
    EXPECT_GT(few.overlay[1], 0.0);
    EXPECT_EQ(few.overlay[2], 0.0);
}

}  // namespace pose_fit_test
}  // namespace dynamic_filter::io
