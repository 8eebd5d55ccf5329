// SPDX-License-Identifier: MIT
#include "filter/vote_kernel.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "filter/vote_scalar.hpp"
#include "support/levels.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace vote_kernel_test {

struct Voters {
    std::vector<float> x, y, z, weight, score, first, last;

    explicit Voters(test::Random& random, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            add({static_cast<float>(random.below(9)), static_cast<float>(random.below(9)),
                 static_cast<float>(random.below(9))},
                random.uniform_f(0.0F, 1.0F), random.uniform_f(-1.0F, 1.0F),
                static_cast<float>(random.below(50)), static_cast<float>(random.below(50)));
        }
        while (x.size() % kernel::kVoters != 0) {
            add(Point::Constant(kernel::kOutOfReach), 0.0F, 0.0F, 0.0F, 0.0F);
        }
    }
    void add(const Point& cell, float share, float value, float from, float duration) {
        x.push_back(cell.x());
        y.push_back(cell.y());
        z.push_back(cell.z());
        weight.push_back(share);
        score.push_back(share * value);
        first.push_back(from);
        last.push_back(from + duration);
    }
    [[nodiscard]] kernel::VoteArgs args(float own, float first_owner, float last_owner) const {
        return {.x = x.data(),
                .y = y.data(),
                .z = z.data(),
                .weight = weight.data(),
                .score = score.data(),
                .first = first.data(),
                .last = last.data(),
                .count = x.size(),
                .own_x = own,
                .own_y = own,
                .own_z = own,
                .own_first = first_owner,
                .own_last = last_owner,
                .company = 1.0F,
                .neighborhood = 2.0F,
                .far = 0.3F,
                .alone = 0.25F};
    }
};

TEST(VoteKernel, EveryLevelAgreesWithTheScalarFormAndBitByBitWithTheOthers) {
    test::Random random(11);
    const auto levels = DYNAMIC_FILTER_LEVELS_OF(vote);
    for (int repeat = 0; repeat < 500; ++repeat) {
        const Voters voters(random, 1 + random.below(300));
        const auto args = voters.args(static_cast<float>(random.below(9)), 10.0F, 40.0F);
        const float baseline = levels[0].run(args);
        EXPECT_NEAR(baseline, kernel::vote_scalar(args), 1e-5F);
        for (const auto& level : levels) EXPECT_EQ(level.run(args), baseline) << level.name;
    }
}

TEST(VoteKernel, NobodyNearSaysNothing) {
    test::Random random(12);
    const Voters voters(random, 0);
    for (const auto& level : DYNAMIC_FILTER_LEVELS_OF(vote)) {
        EXPECT_EQ(level.run(voters.args(0.0F, 0.0F, 0.0F)), 0.0F) << level.name;
    }
}

}  // namespace vote_kernel_test
}  // namespace dynamic_filter
