// SPDX-License-Identifier: MIT
#include "base/natural_order.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace natural_order_test {

TEST(NaturalOrder, NumbersCountAsNumbers) {
    const std::vector<std::string> sorted = {"",
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
                                             "b1.5.pcd",
                                             "b1.25.pcd"};
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        for (std::size_t j = 0; j < sorted.size(); ++j) {
            EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
        }
    }
}

}  // namespace natural_order_test
}  // namespace dynamic_filter::io
