// SPDX-License-Identifier: MIT
#include "recording/times_in_names.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::io {
namespace times_in_names_test {

Paths named(const std::vector<std::string>& stems) {
    Paths scans;
    for (const std::string& stem : stems) scans.emplace_back("/data/" + stem + ".pcd");
    return scans;
}

/// Names of whole numbers: times [s] in a unit.
Paths in_unit(const std::vector<double>& times, double per_second, const std::string& before = "") {
    std::vector<std::string> stems;
    for (const double time : times) {
        stems.push_back(before + fmt::format("{:.0f}", std::round(time * per_second)));
    }
    return named(stems);
}

std::vector<double> every(double step, double first, std::size_t count = 12) {
    std::vector<double> times;
    for (std::size_t i = 0; i < count; ++i) times.push_back(first + step * static_cast<double>(i));
    return times;
}

void expect_times(const Paths& scans, const std::vector<double>& expected, double tolerance,
                  std::optional<double> unit = {}) {
    const std::vector<double> times = times_in_names(scans, unit);
    ASSERT_EQ(times.size(), expected.size()) << scans.front();
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_NEAR(times[i], expected[i], tolerance) << scans[i];
    }
}

// Since 1970, and since a sensor was switched on, at all usual rates.
TEST(TimesInNames, SizeAndStepsTellTheUnitOfWholeNumbers) {
    for (const double first : {1.1e9, 1.7e9, 2.1e9}) {
        for (const double step : {0.05, 0.1, 0.5, 2.0}) {
            for (const double per_second : {1e3, 1e6, 1e9}) {
                for (const char* before : {"", "cloud_", "lidar-"}) {
                    const auto times = every(step, first);
                    expect_times(in_unit(times, per_second, before), times, 1e-3);
                }
            }
        }
        expect_times(in_unit(every(1.0, first), 1.0), every(1.0, first), 1e-6);
    }
    for (const double per_second : {1e6, 1e9}) {
        const auto uptime = every(0.1, 34567.0);
        expect_times(in_unit(uptime, per_second), uptime, 1e-3);
    }
    expect_times(named({"1500000000200000000"}), {1.5e9 + 0.2}, 1e-6);  // no step
    const auto minutes = every(60.0, 1.7e9);
    for (const double per_second : {1.0, 1e6, 1e9}) {
        expect_times(in_unit(minutes, per_second), minutes, 1e-3);
    }
}

TEST(TimesInNames, AUnitThatIsGivenCounts) {
    expect_times(in_unit(every(0.1, 34567.0), 1e9), every(100.0, 34567e3), 1e-3, 1e-6);
    expect_times(named({"100.5", "101.5"}), {0.1005, 0.1015}, 1e-12, 1e-3);
}

TEST(TimesInNames, Decimals) {
    expect_times(named({"0", "0.05", "0.1", "0.95", "1", "1.05"}), {0, 0.05, 0.1, 0.95, 1, 1.05},
                 1e-12);
    expect_times(named({"x_1700000000.0", "x_1700000000.2", "x_1700000000.4021"}),
                 {1.7e9, 1.7e9 + 0.2, 1.7e9 + 0.4021}, 1e-6);
}

TEST(TimesInNames, SecondsAndNanosecondsWithAndWithoutZeros) {
    const std::vector<double> times = {1.7e9 + 0.01, 1.7e9 + 0.21, 1.7e9 + 1.0, 1.7e9 + 1.2};
    expect_times(named({"cloud_1700000000_010000000", "cloud_1700000000_210000000",
                        "cloud_1700000001_000000000", "cloud_1700000001_200000000"}),
                 times, 1e-6);
    expect_times(named({"1700000000_10000000", "1700000000_210000000", "1700000001_0",
                        "1700000001_200000000"}),
                 times, 1e-6);
}

TEST(TimesInNames, OtherNumbersAreNoTimes) {
    for (const std::vector<std::string>& stems :
         {std::vector<std::string>{"000000", "000001", "000002"},
          {"cloud_1", "cloud_2", "cloud_3"},
          {"1.8", "1.9", "1.10", "1.11"},                // numbers of parts
          {"a_1.5", "a_1000.5"},                         // behind a prefix, no usual step
          {"20240102030405", "20240102030406"},          // a date
          {"cloud_1500000000_1", "cloud_1500000000_2"},  // numbers within a second
          {"cloud_1500000000_02", "cloud_1500000000_03"},
          {"1700000000.2", "x_1700000000.4"},  // of two kinds
          {"front", "rear"}}) {
        EXPECT_TRUE(times_in_names(named(stems)).empty()) << stems.front();
    }
    EXPECT_TRUE(times_in_names({}).empty());
}

TEST(TimesInNames, TimesThatDoNotGrowAreOfUseForMatchingOnly) {
    const Paths scans = named({"b_1700000000.4", "b_1700000000.2"});
    EXPECT_EQ(times_in_names(scans).size(), 2U);
    EXPECT_TRUE(growing_times_in_names(scans).empty());
    EXPECT_EQ(growing_times_in_names(named({"0.2", "0.4"})).size(), 2U);
}

}  // namespace times_in_names_test
}  // namespace dynamic_filter::io
