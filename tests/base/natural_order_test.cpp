// SPDX-License-Identifier: MIT
#include "base/natural_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace natural_order_test {

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::shuffle(names.begin(), names.end(), std::mt19937(3));
    std::vector<std::filesystem::path> files(names.begin(), names.end());
    sort_naturally(files);
    names.assign(files.begin(), files.end());
    return names;
}

TEST(NaturalOrder, NumbersCountAsNumbers) {
    const std::vector<std::string> names = {"",
                                            "a",
                                            "a01",
                                            "a1",
                                            "a1b",
                                            "a2",
                                            "a10",
                                            "a010b",
                                            "a99999999999999999999",
                                            "a100000000000000000000",
                                            "ab",
                                            "b1.25.pcd",
                                            "b1.5.pcd"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        for (std::size_t j = 0; j < names.size(); ++j) {
            EXPECT_EQ(natural_less(names[i], names[j]), i < j) << names[i] << " " << names[j];
        }
    }
}

TEST(NaturalOrder, DecimalsCountAsDecimals) {
    const std::vector<std::string> by_awk = {"0.pcd",    "0.05.pcd", "0.1.pcd",
                                             "0.95.pcd", "1.pcd",    "1.05.pcd",
                                             "1.1.pcd",  "1.15.pcd", "2.pcd"};
    EXPECT_EQ(sorted(by_awk), by_awk);
    const std::vector<std::string> by_python = {
        "lidar_1700000000.0.bin", "lidar_1700000000.0021.bin", "lidar_1700000000.2.bin",
        "lidar_1700000000.25.bin", "lidar_1700000001.0.bin"};
    EXPECT_EQ(sorted(by_python), by_python);
}

// Whatever is printed of increasing numbers, with and without zeros at the end.
TEST(NaturalOrder, IsThatOfTheNumbersHoweverTheyArePrinted) {
    for (const double step : {0.05, 0.1, 0.0137, 3.0}) {
        std::vector<std::string> plain, fixed;
        for (int i = 0; i < 60; ++i) {
            const double number = 98.0 + step * i;
            plain.push_back(fmt::format("x{:.6g}.pcd", number));
            fixed.push_back(fmt::format("x{:.4f}.pcd", number));
        }
        EXPECT_EQ(sorted(plain), plain) << step;
        EXPECT_EQ(sorted(fixed), fixed) << step;
    }
}

TEST(NaturalOrder, PointsMaySeparateWholeNumbers) {
    const std::vector<std::string> numbered = {"1.8.pcd", "1.9.pcd", "1.10.pcd", "1.11.pcd",
                                               "2.1.pcd"};
    EXPECT_EQ(sorted(numbered), numbered);
    const std::vector<std::string> dates = {"2024.1.9.pcd", "2024.1.10.pcd", "2024.2.1.pcd"};
    EXPECT_EQ(sorted(dates), dates);
}

}  // namespace natural_order_test
}  // namespace dynamic_filter::io
