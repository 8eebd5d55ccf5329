// SPDX-License-Identifier: MIT
#include "top_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dynamic_filter::app {
namespace {

constexpr io::Color kRed{214, 39, 40};

std::ptrdiff_t red_pixels(const io::Image& image) {
    return std::count(image.pixels.begin(), image.pixels.end(), kRed);
}

TEST(TopView, ShowsRemovedPointsInRedBeforeAndNotAfter) {
    TopView view;
    Points points;
    Labels labels;
    for (int x = 0; x < 100; ++x) {
        for (int y = 0; y < 50; ++y) {
            points.emplace_back(0.1F * static_cast<float>(x) + 0.05F,
                                0.1F * static_cast<float>(y) + 0.05F, 0.0F);
            labels.push_back(x == 40 ? Label::dynamic : y == 0 ? Label::unknown : Label::static_);
        }
    }
    view.add(points, labels);
    const io::Image before = view.draw(true), after = view.draw(false);
    const auto block = static_cast<std::ptrdiff_t>(before.width / 120);  // 100 columns and margins
    ASSERT_GT(block, 1);
    EXPECT_EQ(red_pixels(before), 50 * block * block);
    EXPECT_EQ(red_pixels(after), 0);
    EXPECT_EQ(before.width, after.width);
    EXPECT_EQ(before.height, after.height);
    EXPECT_GT(before.width, before.height);
}

TEST(TopView, DrawsNothingAsOnePixelAndLargeAreasWithinReason) {
    EXPECT_EQ(TopView().draw(true).pixels.size(), 1U);
    TopView view;
    view.add({{-2e4F, 0, 0}, {2e4F, 5, 1}}, {Label::static_, Label::static_});
    EXPECT_LE(view.draw(true).width, 2500);
}

}  // namespace
}  // namespace dynamic_filter::app
