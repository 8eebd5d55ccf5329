// SPDX-License-Identifier: MIT
#include "formats/byte_writer.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace byte_writer_test {

TEST(ByteWriter, WritesLittleEndianNumbersAndBlocksWithTheirLength) {
    ByteWriter out;
    out.number(std::uint16_t{0x0102});
    out.number(1.5F);
    out.text("ab");
    out.raw(std::string_view("c"));
    const std::string bytes(reinterpret_cast<const char*>(out.bytes.data()), out.bytes.size());
    EXPECT_EQ(bytes, std::string("\x02\x01\x00\x00\xC0\x3F\x02\x00\x00\x00"
                                 "abc",
                                 13));
}

}  // namespace byte_writer_test
}  // namespace dynamic_filter::io
