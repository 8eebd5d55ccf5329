// SPDX-License-Identifier: MIT
#include "formats/knowable_file.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::io {
namespace knowable_file_test {

std::string fault_of(const std::filesystem::path& file, std::size_t points) {
    try {
        (void)read_knowable(file, points);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(KnowableFile, IsReadAsItWasWritten) {
    const test::TemporaryFolder folder;
    const std::vector<KnowablePoint> points{{},
                                            {7, ThingState::moves, false},
                                            {65535, ThingState::moved, true},
                                            {256, ThingState::will_move, true},
                                            {0, ThingState::never, false}};
    write_knowable(folder / "a.bin", points);
    EXPECT_EQ(read_knowable(folder / "a.bin", 5), points);
    const std::string bytes = read_file(folder / "a.bin");
    EXPECT_EQ(bytes.substr(4, 4), std::string("\7\0\1\0", 4));
    EXPECT_EQ(bytes.substr(12, 4), std::string("\0\1\3\1", 4));
}

TEST(KnowableFile, FaultsNameTheFileThePlaceAndWhatWasExpected) {
    const test::TemporaryFolder folder;
    const auto file = folder.put("a.bin", std::string("\0\0\0\0\0\0\5\0", 8));
    EXPECT_EQ(fault_of(file, 2),
              file.string() + " (byte 6): state 5 and mark 0; expected 0 to 4, and 0 or 1");
    EXPECT_EQ(fault_of(file, 3), file.string() +
                                     ": has 8 bytes; expected 12, which are 4 for each of the 3 "
                                     "points of the scan");
    EXPECT_NE(fault_of(folder / "none.bin", 2).find("none.bin"), std::string::npos);
    folder.put("a.bin", std::string("\0\0\0\2", 4));
    EXPECT_EQ(fault_of(file, 1),
              file.string() + " (byte 2): state 0 and mark 2; expected 0 to 4, and 0 or 1");
}

}  // namespace knowable_file_test
}  // namespace dynamic_filter::io
