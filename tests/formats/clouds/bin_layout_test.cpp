// SPDX-License-Identifier: MIT
#include "formats/clouds/bin_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "dynamic_filter/error.hpp"
#include "support/random.hpp"

namespace dynamic_filter::io {
namespace bin_layout_test {

/// Rings of a sensor in a hall of 20 x 30 m, as values of this layout.
template <class Number>
BinSample rings(std::size_t values, std::size_t cut = 0) {
    test::Random random(3);
    BinSample sample;
    for (int ring = 0; ring < 8; ++ring) {
        for (int step = 0; step < 200; ++step) {
            const double azimuth = 0.0314159 * step, up = -0.2 + 0.05 * ring;
            const double reach = std::min(10.0 / std::max(std::abs(std::sin(azimuth)), 1e-6),
                                          15.0 / std::max(std::abs(std::cos(azimuth)), 1e-6));
            const double range = reach + random.uniform(-0.02, 0.02);
            std::vector<double> point = {range * std::cos(azimuth),
                                         range * std::sin(azimuth),
                                         range * up,
                                         random.uniform(0.0, 1.0),
                                         static_cast<double>(ring),
                                         1e-4 * step,
                                         0.0,
                                         0.0};
            for (std::size_t k = 0; k < values; ++k) {
                const auto number = static_cast<Number>(point[k]);
                const auto* const bytes = reinterpret_cast<const std::byte*>(&number);
                sample.head.insert(sample.head.end(), bytes, bytes + sizeof number);
            }
        }
    }
    sample.size = sample.head.size() - cut;
    return sample;
}

template <class Number>
std::string chosen(std::size_t values) {
    const std::vector<BinSample> samples(3, rings<Number>(values));
    const BinChoice choice = choose_bin_layout(samples);
    return choice.layout ? to_string(*choice.layout) : "none";
}

TEST(BinLayout, IsToldByTheContents) {
    EXPECT_EQ(chosen<float>(4), "float32 x y z intensity");
    EXPECT_EQ(chosen<float>(3), "float32 x y z");
    EXPECT_EQ(chosen<float>(5), "float32 x y z intensity ring");
    EXPECT_EQ(chosen<float>(6), "float32 x y z intensity ring c5");
    EXPECT_EQ(chosen<float>(8), "float32 x y z intensity ring c5 c6 c7");
    EXPECT_EQ(chosen<double>(3), "float64 x y z");
    EXPECT_EQ(chosen<double>(4), "float64 x y z intensity");
}

TEST(BinLayout, ATruncatedFileAmongTwoOrThreeDoesNotMatter) {
    const BinSample whole = rings<float>(4), cut = rings<float>(4, 7);
    for (const auto& samples : {std::vector{whole, cut}, std::vector{whole, cut, whole}}) {
        const BinChoice choice = choose_bin_layout(samples);
        ASSERT_TRUE(choice.layout);
        EXPECT_EQ(to_string(*choice.layout), "float32 x y z intensity");
    }
}

TEST(BinLayout, OfFewPointsKittisIsTaken) {
    BinSample sample = rings<float>(4);
    sample.head.resize(16 * 20);
    sample.size = 16 * 20;
    const BinChoice choice = choose_bin_layout({{sample}});
    EXPECT_FALSE(choice.is_sure);
    ASSERT_TRUE(choice.layout);
    EXPECT_EQ(choice.layout->point_bytes(), 16U);
}

TEST(BinLayout, OfBytesWithoutOrderNoneIsTaken) {
    test::Random random(4);
    BinSample sample;
    for (int i = 0; i < 48000; ++i) {
        sample.head.push_back(static_cast<std::byte>(random.uniform(0.0, 256.0)));
    }
    sample.size = sample.head.size();
    EXPECT_FALSE(choose_bin_layout({{sample}}).layout);
}

TEST(BinLayout, SizesThatAreNoWholePointsAreNamed) {
    const BinLayout& kitti = bin_layouts().front();
    EXPECT_NO_THROW(refuse_bad_bin_size("a.bin", 64, kitti));
    EXPECT_THROW(refuse_bad_bin_size("a.bin", 0, kitti), InputError);
    try {
        refuse_bad_bin_size("a.bin", 39, kitti);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("byte 32"), std::string::npos) << error.what();
    }
}

}  // namespace bin_layout_test
}  // namespace dynamic_filter::io
