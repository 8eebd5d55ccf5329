// SPDX-License-Identifier: MIT
#include "recording/truth.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::io {
namespace truth_test {

using Indices = std::vector<std::size_t>;

TEST(Truth, ScansHaveItByTheirFilesOrAllByTheirIntensity) {
    Info info;
    info.scan_files = {"a.bin", "b.bin", "c.bin"};
    EXPECT_EQ(scans_with_truth(info), Indices{});
    info.label_files = {"a.label", "", "c.label"};
    EXPECT_EQ(scans_with_truth(info), (Indices{0, 2}));
    info.label_files.clear();
    info.intensity_is_truth = true;
    EXPECT_EQ(scans_with_truth(info), (Indices{0, 1, 2}));
}

TEST(Truth, IsSparseOnPurposeWhereHalfOfTheScansOrMoreLackIt) {
    EXPECT_TRUE(is_sparse_truth(40, 391));
    EXPECT_TRUE(is_sparse_truth(5, 10));
    EXPECT_FALSE(is_sparse_truth(6, 10));
    EXPECT_FALSE(is_sparse_truth(10, 10));
}

}  // namespace truth_test
}  // namespace dynamic_filter::io
