// SPDX-License-Identifier: MIT
#include "filter/archive.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace archive_test {

struct Pair {
    std::uint32_t kept = 7;
    std::uint8_t left_out = 9;
};

TEST(Archive, GivesBackWhatWasWritten) {
    Archive writer;
    double number = 0.1;
    std::vector<std::uint16_t> many{1, 2, 65535};
    std::vector<Pair> pairs{{1, 2}, {3, 4}};
    std::vector<float> none;
    writer.value(number);
    writer.values(many);
    writer.values(pairs, 4);
    writer.values(none);
    const std::vector<std::byte> bytes = writer.take();
    EXPECT_EQ(bytes.size(), 8U + 8U + 6U + 8U + 8U + 8U);

    Archive reader(bytes);
    double number_again = 0.0;
    std::vector<std::uint16_t> many_again{5};
    std::vector<Pair> pairs_again;
    std::vector<float> none_again{1.0F};
    reader.value(number_again);
    reader.values(many_again);
    reader.values(pairs_again, 4);
    EXPECT_FALSE(reader.is_at_end());
    reader.values(none_again);
    EXPECT_TRUE(reader.is_at_end());
    EXPECT_EQ(number_again, number);
    EXPECT_EQ(many_again, many);
    ASSERT_EQ(pairs_again.size(), 2U);
    EXPECT_EQ(pairs_again[1].kept, 3U);
    EXPECT_EQ(pairs_again[1].left_out, 9U);  // the one of a new Pair
    EXPECT_TRUE(none_again.empty());
}

TEST(Archive, RefusesBytesThatEndEarly) {
    Archive writer;
    std::vector<std::uint64_t> many(3);
    writer.values(many);
    const std::vector<std::byte> bytes = writer.take();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        Archive reader{std::span<const std::byte>(bytes).first(size)};
        EXPECT_THROW(reader.values(many), Error) << size;
    }
    std::vector<std::byte> huge(8, std::byte{0xFF});  // so many values that the memory would not do
    Archive reader(huge);
    EXPECT_THROW(reader.values(many), Error);
}

}  // namespace archive_test
}  // namespace dynamic_filter
