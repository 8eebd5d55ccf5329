// SPDX-License-Identifier: MIT
#include "export/thinned_records.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::app {
namespace thinned_records_test {

std::vector<std::byte> record(char name) { return {static_cast<std::byte>(name)}; }

std::string names(const ThinnedRecords& records) {
    std::string text;
    for (const std::byte byte : records.records()) text += static_cast<char>(byte);
    return text;
}

TEST(ThinnedRecords, KeepTheBestOfEachCell) {
    ThinnedRecords records(0.5);
    records.add({0.1, 0.1, 0.1}, 7.0F, false, record('a'));
    records.add({0.6, 0.1, 0.1}, 9.0F, false, record('b'));
    records.add({0.4, 0.4, 0.4}, 6.0F, false, record('c'));  // better than a
    records.add({0.9, 0.4, 0.4}, 9.0F, false, record('d'));  // as good as b, but later
    records.add({-0.1, 0.1, 0.1}, 1.0F, false, record('e'));
    EXPECT_EQ(names(records), "cbe");
}

TEST(ThinnedRecords, KeepWhatMovesApart) {
    ThinnedRecords records(0.5);
    records.add({0.1, 0.1, 0.1}, 1.0F, false, record('s'));
    records.add({0.1, 0.1, 0.1}, 2.0F, true, record('m'));
    EXPECT_EQ(names(records), "sm");
}

TEST(ThinnedRecords, WorkFarFromTheOrigin) {
    ThinnedRecords records(0.01);
    records.add({691579.101, 5334777.421, 520.851}, 1.0F, false, record('a'));
    records.add({691579.109, 5334777.429, 520.859}, 2.0F, false, record('b'));
    records.add({691579.111, 5334777.421, 520.851}, 2.0F, false, record('c'));
    EXPECT_EQ(names(records), "ac");
    EXPECT_HAS(io::error_of<ConfigError>([&] {
                   records.add({0, 0, 0}, 1.0F, false, record('d'));
               }),
               "lie more than 10 km apart");
}

TEST(ThinnedRecords, DistanceToTheMiddle) {
    const ThinnedRecords records(0.5);
    EXPECT_FLOAT_EQ(records.distance_to_middle({0.25, 1.75, -0.25}), 0.0F);
    EXPECT_FLOAT_EQ(records.distance_to_middle({0.5, 1.75, -0.25}), 0.5F);
}

}  // namespace thinned_records_test
}  // namespace dynamic_filter::app
