// SPDX-License-Identifier: MIT
#include "base/edit_distance.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace edit_distance_test {

/// The definition, without a table.
std::size_t by_recursion(std::string_view a, std::string_view b) {
    if (a.empty() || b.empty()) return a.size() + b.size();
    const std::string_view rest_a = a.substr(1), rest_b = b.substr(1);
    if (a[0] == b[0]) return by_recursion(rest_a, rest_b);
    return 1 + std::min({by_recursion(rest_a, b), by_recursion(a, rest_b),
                         by_recursion(rest_a, rest_b)});
}

TEST(EditDistance, EqualsItsDefinition) {
    const std::vector<std::string> words{"",    "a",    "b",     "ab",   "run",
                                         "urn", "runs", "serve", "sevre"};
    for (const auto& a : words) {
        for (const auto& b : words) EXPECT_EQ(edit_distance(a, b), by_recursion(a, b)) << a << b;
    }
}

TEST(NearestWord, IsTheOneThatWasMeant) {
    const std::vector<std::string> commands{"run", "render", "report", "convert"};
    EXPECT_EQ(nearest_word("rnu", commands), "run");
    EXPECT_EQ(nearest_word("reprot", commands), "report");
    EXPECT_EQ(nearest_word("rander", commands), "render");
    EXPECT_EQ(nearest_word("xyzzyxyz", commands), "");
    EXPECT_EQ(nearest_word("run", {}), "");
}

}  // namespace edit_distance_test
}  // namespace dynamic_filter
