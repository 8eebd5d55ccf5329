// SPDX-License-Identifier: MIT
#include "formats/bags/chunked_file.hpp"

#include "formats/byte_reader.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace chunked_file_test {

std::vector<std::byte> bytes(const std::string& text) {
    const auto raw = std::as_bytes(std::span(text));
    return {raw.begin(), raw.end()};
}

/// A record, a chunk and a message are texts that say how they were asked for.
class Told final : public ChunkedFile {
public:
    using ChunkedFile::ChunkedFile;
    std::vector<Defect> for_each(const UseMessage&) const override { return {}; }

    mutable std::vector<std::uint64_t> chunks_read;
    std::string fault;

protected:
    [[nodiscard]] std::vector<std::byte> record_at(std::uint64_t at) const override {
        return bytes("record " + std::to_string(at));
    }
    [[nodiscard]] std::vector<std::byte> read_chunk(std::uint64_t at) const override {
        chunks_read.push_back(at);
        return bytes("chunk " + std::to_string(at));
    }
    [[nodiscard]] std::vector<std::byte> message_in(std::span<const std::byte> in,
                                                    std::uint64_t offset) const override {
        if (!fault.empty()) throw Malformed(fault);
        return bytes(std::string(as_text(in)) + ", byte " + std::to_string(offset));
    }
};

class ChunkedFileTest : public testing::Test {
protected:
    [[nodiscard]] std::string read(std::uint64_t chunk, std::uint64_t offset) const {
        return std::string(as_text(told_.read(chunk, offset)));
    }
    TemporaryFolder folder_;
    Told told_{folder_.put("a.mcap", "any")};
};

TEST_F(ChunkedFileTest, MessagesAreInAChunkOrARecordOfTheFile) {
    EXPECT_EQ(read(40, 7), "chunk 40, byte 7");
    EXPECT_EQ(read(0, 9), "chunk 0, byte 9");
    EXPECT_EQ(read(kNoChunk, 9), "record 9, byte 0");
}

TEST_F(ChunkedFileTest, ChunksThatWereReadLastAreKept) {
    using Chunks = std::vector<std::uint64_t>;
    for (const std::uint64_t chunk : {1U, 1U, 2U, 1U, 3U, 4U, 1U}) {
        EXPECT_EQ(read(chunk, 5), "chunk " + std::to_string(chunk) + ", byte 5");
    }
    EXPECT_EQ(told_.chunks_read, (Chunks{1, 2, 3, 4}));
    for (const std::uint64_t chunk : {5U, 4U, 2U, 1U}) (void)read(chunk, 0);  // 5 replaces 1
    EXPECT_EQ(told_.chunks_read, (Chunks{1, 2, 3, 4, 5, 1}));
}

TEST_F(ChunkedFileTest, FaultsAreNamedWithThePlaceInTheFile) {
    told_.fault = "is cut off";
    const std::string file = (folder_ / "a.mcap").string();
    EXPECT_EQ(error_of([&] { (void)read(40, 7); }), file + " (byte 40): is cut off");
    EXPECT_EQ(error_of([&] { (void)read(kNoChunk, 7); }), file + " (byte 7): is cut off");
}

TEST_F(ChunkedFileTest, AFileThatIsNotThereIsNamed) {
    EXPECT_HAS(error_of([&] { Told{folder_ / "none.mcap"}; }), "none.mcap");
}

}  // namespace chunked_file_test
}  // namespace dynamic_filter::io
