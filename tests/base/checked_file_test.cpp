// SPDX-License-Identifier: MIT
#include "base/checked_file.hpp"
#include "base/crc.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/random.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace checked_file_test {

std::vector<std::byte> some_bytes(std::size_t count) {
    test::Random random(7);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.below(256));
    return bytes;
}

TEST(CheckedFile, PackedBytesComeBack) {
    for (const std::size_t count : {0U, 1U, 1000U}) {
        const auto bytes = some_bytes(count);
        EXPECT_EQ(unpacked(packed(bytes), count, "file"), bytes);
    }
    EXPECT_THROW(unpacked(packed(some_bytes(10)), 11, "file"), InputError);
    EXPECT_THROW(unpacked(some_bytes(10), 5, "file"), InputError);
}

TEST(CheckedFile, TheChecksumIsThatOfZip) {
    const std::string text = "123456789";
    EXPECT_EQ(crc_of(std::as_bytes(std::span(text))), 0xCBF43926U);
}

TEST(CheckedFile, FingerprintsTellTextsApart) {
    EXPECT_EQ(fingerprint(""), "cbf29ce484222325");
    EXPECT_EQ(fingerprint("a"), "af63dc4c8601ec8c");  // a published value of FNV-1a
    EXPECT_NE(fingerprint("ab"), fingerprint("ba"));
}

TEST(CheckedFile, IsReadBackByItsRunOnly) {
    const test::TemporaryFolder folder;
    const auto bytes = some_bytes(100);
    write_checked(folder / "file", "magic-1", "run", bytes);
    EXPECT_EQ(read_checked(folder / "file", "magic-1", "run"), bytes);
    EXPECT_THROW(read_checked(folder / "file", "magic-2", "run"), InputError);
    EXPECT_THROW(read_checked(folder / "file", "magic-1", "another"), ConfigError);
}

TEST(CheckedFile, AnyByteThatDiffersIsNoticed) {
    const test::TemporaryFolder folder;
    write_checked(folder / "file", "magic-1", "run", some_bytes(50));
    const std::string whole = test::slurp(folder / "file");
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string spoilt = whole;
        spoilt[i] = static_cast<char>(spoilt[i] ^ 1);
        test::spill(folder / "file", spoilt);
        EXPECT_THROW(read_checked(folder / "file", "magic-1", "run"), Error) << i;
    }
    test::spill(folder / "file", whole.substr(0, whole.size() - 1));
    EXPECT_THROW(read_checked(folder / "file", "magic-1", "run"), InputError);
}

}  // namespace checked_file_test
}  // namespace dynamic_filter::app
