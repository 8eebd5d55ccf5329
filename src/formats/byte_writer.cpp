// SPDX-License-Identifier: MIT
#include "formats/byte_writer.hpp"

namespace dynamic_filter::io {

// Not inlined: otherwise GCC 12 warns of an overflow that cannot happen.
void ByteWriter::raw(std::span<const std::byte> data) {
    bytes.insert(bytes.end(), data.begin(), data.end());
}

}  // namespace dynamic_filter::io
