// SPDX-License-Identifier: MIT
// Records of MCAP that are unknown, misplaced or wrong: each is passed over, and what can be read
// is.
#include "base/input.hpp"
#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace mcap_test {

const std::string announced = mcap::schema(1, "nav_msgs/msg/Odometry") + mcap::channel(0, 1, "/a");

class Mcap : public testing::Test {
protected:
    /// The notes, of a file whose only readable message is "good".
    [[nodiscard]] std::string notes(const std::string& records) const {
        const ReadBack back = read_all(folder_.put("a.mcap", mcap::file(records)));
        EXPECT_EQ(back.messages.size(), 1U);
        for (const WrittenMessage& m : back.messages) EXPECT_EQ(as_text(m.data), "good");
        std::string all;
        for (const std::string& note : back.notes) all += note + "\n";
        return all;
    }
    TemporaryFolder folder_;
};

TEST_F(Mcap, UnknownRecordsAreNoDefect) {
    const std::string unknown = mcap::record(0x42, "something") + mcap::record(0xFF, "");
    EXPECT_EQ(notes(unknown + announced + unknown + mcap::message(0, 1, "good") + unknown), "");
    EXPECT_EQ(notes(mcap::chunk("lz4", unknown + announced + mcap::message(0, 1, "good"))), "");
}

TEST_F(Mcap, AMessageBeforeItsChannelIsLeftOut) {
    EXPECT_HAS(notes(mcap::message(0, 1, "early") + announced + mcap::message(0, 1, "good")),
               "1 messages of channels without a channel record");
}

TEST_F(Mcap, AChannelWithoutASchemaHasNoType) {
    EXPECT_HAS(notes(mcap::channel(5, 0, "/b") + mcap::message(5, 1, "untyped") + announced +
                     mcap::message(0, 1, "good")),
               "1 messages of channels without a channel record");
}

TEST_F(Mcap, ChunksDoNotNest) {
    const std::string inner = mcap::chunk("", announced + mcap::message(0, 1, "inner"));
    EXPECT_HAS(notes(mcap::chunk("zstd", announced + inner + mcap::message(0, 1, "good"))),
               "holds another chunk");
}

TEST_F(Mcap, LengthsBeyondTheEnd) {
    const std::string start = announced + mcap::message(0, 1, "good");
    for (const std::uint64_t length : {std::uint64_t{1} << 32U, std::uint64_t{1} << 63U, ~0UL}) {
        for (const char opcode : {'\x03', '\x05', '\x06', '\x42'}) {
            EXPECT_HAS(notes(start + opcode + bytes_of(length)), "is cut off");
        }
        const std::string in_chunk = start + '\x05' + bytes_of(length);
        EXPECT_HAS(notes(mcap::chunk("", in_chunk)), "should follow byte");
    }
}

TEST_F(Mcap, RecordsThatAreTooShort) {
    const std::string start = announced + mcap::message(0, 1, "good");
    for (const int opcode : {3, 4, 5}) {
        EXPECT_HAS(notes(start + mcap::record(opcode, "?")), "a record at byte ");
    }
    EXPECT_HAS(notes(start + mcap::record(6, "?")), "the chunk at byte ");
}

TEST_F(Mcap, UnknownCompressionsAreNamed) {
    EXPECT_HAS(notes(announced + mcap::message(0, 1, "good") + mcap::chunk("xz", "?")), "'xz'");
}

TEST_F(Mcap, MessagesThatAreNotThereCannotBeRead) {
    const Bag bag(folder_.put("a.mcap", mcap::file(mcap::chunk("", announced) + announced)));
    const std::uint64_t none = UINT64_MAX;
    EXPECT_THROW((void)bag.read({0, none, 1U << 20U}), InputError);
    EXPECT_HAS(error_of([&] { (void)bag.read({0, none, 8}); }), "(byte 8): ends at byte");
}

}  // namespace mcap_test
}  // namespace dynamic_filter::io
