// SPDX-License-Identifier: MIT
#include "formats/clouds/lzf.hpp"

#include <algorithm>
#include <cstdint>

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace lzf_test {

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

void expect_packs(const std::string& bytes, std::size_t most) {
    const auto packed = lzf_pack(std::as_bytes(std::span(bytes)));
    EXPECT_LE(packed.size(), most);
    const std::string stream(reinterpret_cast<const char*>(packed.data()), packed.size());
    EXPECT_TRUE(expand(stream, bytes.size()) == bytes) << bytes.size();
}

TEST(Lzf, PacksAndExpands) {
    for (std::size_t n = 0; n < 40; ++n) expect_packs(std::string(n, 'a'), n + 2);
    expect_packs(std::string(100000, '\0'), 1200);
    std::string noise, again;
    std::uint32_t state = 1;
    for (int i = 0; i < 20000; ++i) {
        state = state * 1664525U + 1013904223U;
        noise += static_cast<char>(state >> 24U);
    }
    expect_packs(noise, noise.size() + noise.size() / 32 + 1);
    for (const std::size_t back : {1U, 2U, 255U, 256U, 8191U, 8192U, 8193U, 9000U}) {
        again = noise.substr(0, back) + noise.substr(0, std::min<std::size_t>(back, 300));
        expect_packs(again + again, 2 * again.size() + again.size() / 16 + 2);
    }
}

}  // namespace lzf_test
}  // namespace dynamic_filter::io
