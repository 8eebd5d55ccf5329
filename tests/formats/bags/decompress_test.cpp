// SPDX-License-Identifier: MIT
#include "formats/bags/decompress.hpp"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "dynamic_filter/error.hpp"
#include "formats/byte_reader.hpp"
#include "support/random.hpp"
#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace decompress_test {

std::string as_text(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
Decompressed decompressed(const std::string& kind, const std::string& packed, std::uint64_t size) {
    return decompress(name_of(kind), std::as_bytes(std::span(packed)), size);
}

/// Half of it repeats, half of it does not.
std::string sample(std::size_t size) {
    test::Random random(5);
    std::string text(size, 'x');
    for (std::size_t i = 0; i < size; i += 2) text[i] = static_cast<char>('a' + random.below(26));
    return text;
}

constexpr const char* kKinds[] = {"", "none", "zstd", "lz4", "lz4 block", "bz2"};

TEST(Decompress, GivesBackWhatWasCompressed) {
    for (const char* kind : kKinds) {
        for (const std::size_t size : {1U, 100U, 70'000U, 3'000'000U}) {
            const std::string text = sample(size);
            const Decompressed out = decompressed(kind, packed(kind, text), size);
            EXPECT_TRUE(out.complete) << kind << " " << size;
            EXPECT_TRUE(as_text(out.bytes) == text) << kind << " " << size;
        }
    }
}

TEST(Decompress, GivesTheBeginningOfWhatIsCutOff) {
    const std::string text = sample(5000);
    for (const char* kind : kKinds) {
        const std::string all = packed(kind, text);
        for (std::size_t n = 0; n < all.size(); n += 37) {
            const Decompressed out = decompressed(kind, all.substr(0, n), text.size());
            EXPECT_EQ(as_text(out.bytes), text.substr(0, out.bytes.size())) << kind << " " << n;
            EXPECT_EQ(out.complete, out.bytes.size() == text.size()) << kind << " " << n;
        }
    }
}

TEST(Decompress, NeverGivesMoreThanIsDeclared) {
    const std::string text = sample(5000);
    for (const char* kind : {"zstd", "lz4", "lz4 block", "bz2"}) {
        const Decompressed out = decompressed(kind, packed(kind, text), 1000);
        EXPECT_LE(out.bytes.size(), 1000U) << kind;
        EXPECT_FALSE(decompressed(kind, packed(kind, text), 6000).complete) << kind;
    }
}

/// Changes a literal of the content, so that its length stays what it was.
std::string with_another_literal(std::string packed) {
    const std::size_t at = packed.find("MARK");
    EXPECT_NE(at, std::string::npos);
    packed.replace(at, 4, "MARX");
    return packed;
}

TEST(Decompress, AChecksumThatDisagreesIsNoticed) {
    const std::string text = "MARK" + sample(200);
    LZ4F_preferences_t lz4{};
    lz4.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
    std::string frame(LZ4F_compressFrameBound(text.size(), &lz4), '\0');
    frame.resize(LZ4F_compressFrame(frame.data(), frame.size(), text.data(), text.size(), &lz4));
    EXPECT_TRUE(decompressed("lz4", frame, text.size()).complete);
    EXPECT_FALSE(decompressed("lz4", with_another_literal(frame), text.size()).complete);

    std::string zstd(ZSTD_compressBound(text.size()), '\0');
    ZSTD_CCtx* const context = ZSTD_createCCtx();
    ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
    zstd.resize(ZSTD_compress2(context, zstd.data(), zstd.size(), text.data(), text.size()));
    ZSTD_freeCCtx(context);
    EXPECT_TRUE(decompressed("zstd", zstd, text.size()).complete);
    zstd.back() = static_cast<char>(~zstd.back());  // of the checksum
    EXPECT_FALSE(decompressed("zstd", zstd, text.size()).complete);
}

TEST(Decompress, RefusesOtherCompressions) {
    EXPECT_THROW(decompressed("snappy", "x", 1), Malformed);
}

}  // namespace decompress_test
}  // namespace dynamic_filter::io
