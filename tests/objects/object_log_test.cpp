// SPDX-License-Identifier: MIT
#include "objects/object_log.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace object_log_test {

using Places = std::vector<Eigen::Vector3d>;

/// A person of 30 points around a place in the plane.
void add_person(Places& places, double x, double y) {
    for (int k = 0; k < 30; ++k) places.emplace_back(x + 0.01 * (k % 5), y, 0.06 * k);
}

/// 40 scans at 10 Hz, told of as they are known: one walks east at 1.5 m/s; a stray echo in scan 3;
/// one that is seen from scan 20 on and stands.
std::vector<KnownScan> told() {
    std::vector<KnownScan> scans;
    ObjectLog log([&](KnownScan scan) { scans.push_back(std::move(scan)); });
    for (std::size_t i = 0; i < 40; ++i) {
        Places places;
        if (i == 3) {
            for (int k = 0; k < 8; ++k) places.emplace_back(-8.0, -8.0, 0.1 * k);
        }
        add_person(places, 0.15 * static_cast<double>(i), 0.0);
        if (i >= 20) add_person(places, 3.0, 9.0);
        log.add(i, 0.1 * static_cast<double>(i), places);
        EXPECT_EQ(scans.empty(), i < 2);  // what was seen twice may be a stray echo
    }
    log.finish();
    EXPECT_EQ(log.size(), 2U);
    return scans;
}

TEST(ObjectLog, TellsOfEachScanOnceAndInOrder) {
    const std::vector<KnownScan> scans = told();
    ASSERT_EQ(scans.size(), 40U);
    for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(scans[i].scan, i);
        ASSERT_EQ(scans[i].objects.size(), i < 20 ? 1U : 2U);
        const std::size_t stray = i == 3 ? 8 : 0;
        for (std::size_t k = 0; k < scans[i].numbers.size(); ++k) {
            const std::size_t person = (k - stray) / 30;  // if it is none of the stray echo
            EXPECT_EQ(scans[i].numbers[k], k < stray ? 0U : person + 1);
        }
        const SeenObject& walks = scans[i].objects[0];
        EXPECT_EQ(walks.box.object, 1U);
        EXPECT_EQ(walks.box.scan, i);
        EXPECT_EQ(walks.places.size(), 30U);
        EXPECT_NEAR(walks.box.center.x(), 0.15 * static_cast<double>(i) + 0.02, 1e-6);
    }
}

}  // namespace object_log_test
}  // namespace dynamic_filter::app
