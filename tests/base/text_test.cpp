// SPDX-License-Identifier: MIT
#include "base/text.hpp"

#include <cmath>

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace text_test {

TEST(Text, LinesKnowTheirNumberAndOffset) {
    Lines lines("one\r\n\ntwo", "f");
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "one");
    EXPECT_EQ(lines.offset(), 5U);
    ASSERT_TRUE(lines.next());
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "two");
    EXPECT_EQ(lines.number(), 3U);
    EXPECT_FALSE(lines.next());
    EXPECT_EQ(error_of([&] { lines.fail("bad"); }), "f (line 3): bad");
}

TEST(Text, NumbersAreWholeTokensWhateverTheLocale) {
    EXPECT_EQ(parse_real("+1.5e1"), 15.0);
    EXPECT_TRUE(std::isnan(*parse_real("nan")));
    EXPECT_TRUE(std::isinf(*parse_real("-inf")));
    for (const char* bad : {"", "1,5", "1.5x", "+-1", "0x10", "abc"}) EXPECT_FALSE(parse_real(bad));
    EXPECT_EQ(parse_count("18446744073709551615"), 18446744073709551615ULL);
    for (const char* bad : {"", "-1", "+5", "1e9", "007", "18446744073709551616", "1.0"}) {
        EXPECT_FALSE(parse_count(bad)) << bad;
    }
}

TEST(Text, NumbersWithCommas) {
    EXPECT_EQ(parse_reals("1, -2.5,3e2"), (std::vector<double>{1.0, -2.5, 300.0}));
    EXPECT_EQ(parse_reals("7"), std::vector<double>{7.0});
    for (const char* bad : {"", "1,", ",1", "1,,2", "1;2", "1,nan", "inf,1", "1 2"}) {
        EXPECT_TRUE(parse_reals(bad).empty()) << bad;
    }
}

TEST(Text, SplitsAndQuotes) {
    EXPECT_EQ(split_tokens("  a\tb  c ").size(), 3U);
    EXPECT_EQ(split_at("a, b,,", ',').size(), 4U);
    EXPECT_EQ(split_at("a, b", ',')[1], "b");
    EXPECT_EQ(quote(std::string("a\x01", 2)), "'a?'");
    EXPECT_EQ(quote(std::string(100, 'a')), "'" + std::string(40, 'a') + "...'");
    EXPECT_FALSE(product(1ULL << 63U, 2));
}

TEST(Lines, AUtf8MarkIsNoPartOfTheFirstLine) {
    Lines lines(
        "\xEF\xBB\xBF"
        "1 2\n3",
        "f");
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "1 2");
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "3");
}

}  // namespace text_test
}  // namespace dynamic_filter::io
