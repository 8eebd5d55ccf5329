// SPDX-License-Identifier: MIT
#include "filter/instant.hpp"

#include <gtest/gtest.h>

#include "filter/evidence_map.hpp"
#include "filter/method.hpp"
#include "filter/vote.hpp"
#include "support/filled_map.hpp"

namespace dynamic_filter {
namespace instant_test {

using test::every_scan;

TEST(InstantVerdicts, AskedWithoutReserveAreThoseOfTheEvidenceSoFar) {
    Config config = every_scan();
    config.scans.vote.ask_again = -1.0;  // whatever the score: every voxel is judged anew
    EvidenceMap map(config);
    InstantVerdicts instant(config);
    StageTimes times;
    int known = 0;
    for (const auto& s : test::drive(8, true)) {
        const PointVoxels voxels = map.insert(s.scan, times);
        const Verdict verdict = instant.judge(s.scan.index, voxels, map.grid());
        EXPECT_EQ(verdict.index, s.scan.index);
        ASSERT_EQ(verdict.probability.size(), voxels.size());
        for (std::size_t i = 0; i < voxels.size(); i += 17) {
            const auto occupancy = occupancy_of(map.grid(), {&voxels[i], 1}, config.scans);
            EXPECT_EQ(verdict.labels[i], label_of(occupancy[0], config.map.occupancy_threshold));
            EXPECT_NEAR(verdict.probability[i], occupancy[0].value_or(0.0F), 0.5F / 255.0F + 1e-6F);
            known += occupancy[0] ? 1 : 0;
        }
        map.observe_elsewhere(times);
    }
    EXPECT_GT(known, 100);
}

TEST(InstantVerdicts, AreRememberedByTheNewNumbersOfVoxels) {
    const Config config = every_scan();
    EvidenceMap map(config);
    InstantVerdicts instant(config);
    StageTimes times;
    const auto scans = test::drive(8, true);
    PointVoxels voxels;
    Verdict before;
    for (const auto& s : scans) {
        voxels = map.insert(s.scan, times);
        before = instant.judge(s.scan.index, voxels, map.grid());
        map.observe_elsewhere(times);
    }
    instant.keep(map.keep_within(Point(0.0F, 0.0F, 1.0F), 100.0F, SIZE_MAX));
    const Verdict after = instant.judge(9, voxels, map.grid());
    EXPECT_EQ(after.labels.size(), before.labels.size());
}

}  // namespace instant_test
}  // namespace dynamic_filter
