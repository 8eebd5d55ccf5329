// SPDX-License-Identifier: MIT
#include "formats/bags/chunked_file.hpp"

#include "dynamic_filter/error.hpp"
#include "formats/byte_reader.hpp"

namespace dynamic_filter::io {

std::vector<std::byte> ChunkedFile::read(std::uint64_t chunk, std::uint64_t offset) const {
    try {
        if (chunk == kNoChunk) return message_in(record_at(offset), 0);
        return message_in(*chunks_.at(chunk, [&] { return read_chunk(chunk); }), offset);
    } catch (const Malformed& error) {
        const std::uint64_t at = chunk == kNoChunk ? offset : chunk;
        throw InputError(file_.path(), "byte " + std::to_string(at), error.what());
    }
}

}  // namespace dynamic_filter::io
