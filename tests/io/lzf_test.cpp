// SPDX-License-Identifier: MIT
#include "io/lzf.hpp"

#include "io/support.hpp"

namespace dynamic_filter::io {
namespace {

std::optional<std::string> expand(const std::string& stream, std::size_t size) {
    const auto bytes = lzf_expand(std::as_bytes(std::span(stream)), size);
    if (!bytes) return std::nullopt;
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

TEST(Lzf, LiteralsAndRepeats) {
    EXPECT_EQ(expand(std::string("\x02") + "abc", 3), "abc");
    // "ab", then 4 bytes from 2 back (overlapping), then 2+7+1 from 1 back.
    const std::string stream = std::string("\x01") + "ab" + std::string("\x40\x01\xe0\x01\x00", 5);
    EXPECT_EQ(expand(stream, 16), "abababbbbbbbbbbb");
    EXPECT_EQ(expand("", 0), "");
}

TEST(Lzf, RefusesDamage) {
    EXPECT_FALSE(expand(std::string("\x02") + "ab", 3));                 // literal beyond the input
    EXPECT_FALSE(expand(std::string("\x02") + "abc", 2));                // beyond the output
    EXPECT_FALSE(expand(std::string("\x02") + "abc", 4));                // too little output
    EXPECT_FALSE(expand(std::string("\x20\x00", 2), 3));                 // nothing to refer to
    EXPECT_FALSE(expand(std::string("\x00", 1) + "a" + "\x20", 4));      // offset missing
    EXPECT_FALSE(expand(std::string("\x00", 1) + "a" + "\xe0", 40));     // length missing
    EXPECT_FALSE(expand(std::string(20, '\0'), std::size_t{4} << 30U));  // a bomb's size
}

}  // namespace
}  // namespace dynamic_filter::io
