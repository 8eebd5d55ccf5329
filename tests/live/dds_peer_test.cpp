// SPDX-License-Identifier: MIT
// What the bus of DDS exchanges with eProsima's Fast DDS in another process.

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <sstream>

#include "live/dds_bus.hpp"
#include "live/dds_configuration.hpp"
#include "live/dds_support.hpp"
#include "live/peer_process.hpp"

namespace dynamic_filter::live {
namespace dds_peer_test {

using std::string_literals::operator""s;

const std::string kType = "sensor_msgs::msg::dds_::PointCloud2_";

struct DdsPeer : testing::Test {
    ReservedDomain domain;
    DdsBus bus;
    io::Topic cloud{"/points", "sensor_msgs/PointCloud2", io::MessageEncoding::cdr};
    Inbox inbox;

    explicit DdsPeer(bool loses_packets = false)
        : bus({.domain = domain.number(), .network = network(loses_packets)}) {}

    /// As the user would configure it for a test of losses.
    [[nodiscard]] std::string network(bool loses_packets) const {
        if (!loses_packets) return "localhost";
        std::string configuration = dds_configuration("localhost", domain.number());
        const std::string start = "<Internal>";
        configuration.insert(configuration.find(start) + start.size(),
                             "<Test><XmitLossiness>100</XmitLossiness></Test>");  // of 1000
        setenv("CYCLONEDDS_URI", configuration.c_str(), 1);
        return "";
    }

    /// Starts a peer, and waits until it takes part.
    std::unique_ptr<PeerProcess> start(const std::string& mode,
                                       std::vector<std::string> options = {}) {
        options.insert(options.begin(),
                       {FASTDDS_PEER, mode, "domain=" + std::to_string(domain.number())});
        auto peer = std::make_unique<PeerProcess>(std::move(options));
        EXPECT_TRUE(eventually([&] { return !peer->said("ready").empty(); }));
        return peer;
    }

    /// Sends small messages until one arrives: what is sent earlier, while both sides find each
    /// other, may be lost.
    void connect_from(PeerProcess& peer) {
        std::size_t rounds = peer.said("done").size();
        EXPECT_TRUE(eventually([&] {
            peer.write("1 1000 40\n");
            ++rounds;
            return eventually([&] { return inbox.size() > 0; }, 0.2);
        }));
        EXPECT_TRUE(eventually([&] { return peer.said("done").size() == rounds; }));
    }
    void connect_to(PeerProcess& peer) {
        ASSERT_TRUE(eventually([&] {
            bus.publish("/points", 0.0, random_message(40, 0));
            return eventually([&] { return !peer.said("got").empty(); }, 0.2);
        }));
    }

    static Bytes random_message(std::size_t size, unsigned seed) {
        auto bytes = std::make_shared<std::vector<std::byte>>(size);
        std::minstd_rand random(seed + 1);
        for (std::byte& b : *bytes) b = static_cast<std::byte>(random() >> 8U);
        for (std::size_t i = 0; i < 4; ++i) (*bytes)[i] = static_cast<std::byte>(i == 1 ? 1 : 0);
        return bytes;
    }

    /// True if the message is the one of "SIZE HASH", with up to three bytes of padding.
    static bool is(const Bytes& message, const std::string& size_and_hash) {
        std::istringstream in(size_and_hash);
        std::size_t size = 0;
        std::uint64_t hash = 0;
        in >> size >> std::hex >> hash;
        return message->size() >= size && message->size() < size + 4 &&
               fnv1a(std::span(*message).first(size)) == hash;
    }
    static std::string size_and_hash(std::vector<std::byte> message) {
        message.resize((message.size() + 3) / 4 * 4);
        std::ostringstream out;
        out << message.size() << ' ' << std::hex << fnv1a(message);
        return out.str();
    }

    bool last_arrived(PeerProcess& peer) const {
        return is(inbox.messages().back(), peer.said("sent").back());
    }
    /// The last `count` that were sent are the last that arrived, in their order.
    void expect_last(std::size_t count, PeerProcess& peer) {
        const auto sent = peer.said("sent");
        const auto got = inbox.messages();
        ASSERT_GE(sent.size(), count);
        ASSERT_GE(got.size(), count);
        for (std::size_t i = 1; i <= count; ++i) {
            EXPECT_TRUE(is(got[got.size() - i], sent[sent.size() - i])) << i << " before the end";
        }
    }
    /// All that the peer sends now arrives; the last of it is no repetition.
    void expect_exact(PeerProcess& peer, std::size_t count, const std::string& rate_and_sizes) {
        connect_from(peer);
        const std::size_t rounds = peer.said("done").size();
        peer.write(std::to_string(count) + " " + rate_and_sizes + "\n");
        ASSERT_TRUE(eventually([&] { return peer.said("done").size() > rounds; }));
        ASSERT_TRUE(eventually([&] { return last_arrived(peer); })) << inbox.size() << " arrived";
        expect_last(count, peer);
    }
    /// All that the bus sends now arrives.
    void publish_and_expect_exact(PeerProcess& peer, unsigned count,
                                  const std::vector<std::size_t>& sizes) {
        std::vector<std::string> sent;
        for (unsigned i = 0; i < count; ++i) {
            const Bytes message = random_message(sizes[i % sizes.size()], i);
            sent.push_back(size_and_hash(*message));
            ASSERT_TRUE(bus.publish("/points", 0.0, message));
        }
        std::vector<std::string> got;
        ASSERT_TRUE(eventually([&] {
            got = peer.said("got");
            return got.size() > count && std::equal(sent.rbegin(), sent.rend(), got.rbegin());
        })) << got.size()
            << " arrived";
    }
};

constexpr Quality kReliable{.reliable = true, .latched = false, .depth = 400};
constexpr Quality kBestEffort{.reliable = false, .latched = false, .depth = 400};
constexpr Quality kLatched{.reliable = true, .latched = true, .depth = 1};

TEST_F(DdsPeer, SmallReliableMessagesArriveExactly) {
    bus.subscribe(cloud, kReliable, inbox.receive());
    const auto peer = start("publish", {"depth=0"});
    expect_exact(*peer, 300, "2000 4 5 6 7 100 1000 60000");
    EXPECT_EQ(bus.lost(), 0U);
    peer->end_input();
    EXPECT_EQ(peer->wait(), 0);
}

TEST_F(DdsPeer, LargeReliableMessagesArriveExactly) {
    const auto peer = start("publish", {"depth=0"});
    bus.subscribe(cloud, kReliable, inbox.receive());
    expect_exact(*peer, 10, "20 4000000 65536 4000001 5 70000");
}

TEST_F(DdsPeer, BestEffortMessagesArriveWhole) {
    const auto peer = start("publish", {"reliable=0"});
    bus.subscribe(cloud, kBestEffort, inbox.receive());
    connect_from(*peer);
    std::size_t rounds = peer->said("done").size();
    ASSERT_TRUE(eventually([&] {
        peer->write("5 20 4000000 100\n");
        ++rounds;
        return eventually([&] { return inbox.size() > 10; }, 0.5);
    }));
    // What was sent is known only after it has arrived.
    ASSERT_TRUE(eventually([&] { return peer->said("done").size() == rounds; }));
    const auto sent = peer->said("sent");
    for (const Bytes& message : inbox.messages()) {
        EXPECT_TRUE(std::any_of(sent.begin(), sent.end(), [&](const std::string& line) {
            return is(message, line);
        })) << message->size();
    }
}

TEST_F(DdsPeer, ReliableWritersServeBestEffortReaders) {
    const auto peer = start("publish");
    bus.subscribe(cloud, kBestEffort, inbox.receive());
    connect_from(*peer);
    EXPECT_TRUE(eventually([&] { return last_arrived(*peer); }));
}

TEST_F(DdsPeer, OwnReliableMessagesArriveExactly) {
    bus.advertise(cloud, kReliable);
    const auto peer = start("subscribe", {"depth=0"});
    connect_to(*peer);
    publish_and_expect_exact(*peer, 80, {4, 5, 7, 100, 60000, 65537, 1000001, 4000000});
}

TEST_F(DdsPeer, OwnBestEffortMessagesArriveWhole) {
    bus.advertise(cloud, kBestEffort);
    const auto peer = start("subscribe", {"reliable=0"});
    connect_to(*peer);
    const Bytes message = random_message(4000000, 1);
    const std::string expected = size_and_hash(*message);
    ASSERT_TRUE(eventually([&] {
        bus.publish("/points", 0.0, message);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        const auto got = peer->said("got");
        return std::find(got.begin(), got.end(), expected) != got.end();
    }));
}

TEST_F(DdsPeer, LateSubscribersGetLatchedMessages) {
    const auto peer = start("publish", {"latched=1", "depth=1", "topic=rt/tf_static",
                                        "type=tf2_msgs::msg::dds_::TFMessage_"});
    peer->write("3 1000 100 200 300\n");
    ASSERT_TRUE(eventually([&] { return !peer->said("done").empty(); }));
    bus.subscribe({"/tf_static", "tf2_msgs/TFMessage", io::MessageEncoding::cdr}, kLatched,
                  inbox.receive());
    ASSERT_TRUE(eventually([&] { return inbox.size() == 1; }));
    expect_last(1, *peer);
}

TEST_F(DdsPeer, LatePeersGetOwnLatchedMessages) {
    bus.advertise(cloud, kLatched);
    for (unsigned i = 0; i < 3; ++i) bus.publish("/points", 0.0, random_message(70000, i));
    const auto peer = start("subscribe", {"latched=1"});
    ASSERT_TRUE(eventually([&] { return !peer->said("got").empty(); }));
    EXPECT_EQ(peer->said("got"), std::vector{size_and_hash(*random_message(70000, 2))});
}

TEST_F(DdsPeer, ReliableReadersGetNothingFromBestEffortWriters) {
    bus.subscribe(cloud, kReliable, inbox.receive());
    const auto peer = start("publish", {"reliable=0"});
    ASSERT_TRUE(eventually([&] { return bus.seen().size() == 1; }));
    EXPECT_EQ(bus.seen()[0].name, "/points");
    EXPECT_EQ(bus.seen()[0].type, "sensor_msgs/PointCloud2");
    EXPECT_EQ(bus.seen()[0].publishers, 1U);
    EXPECT_FALSE(bus.seen()[0].offered.reliable);
    EXPECT_FALSE(bus.seen()[0].offered.latched);
    peer->write("20 100 100\n");
    ASSERT_TRUE(eventually([&] { return !peer->said("done").empty(); }));
    EXPECT_EQ(inbox.size(), 0U);
    // What is offered tells how to ask.
    bus.subscribe(cloud, bus.seen()[0].offered, inbox.receive());
    connect_from(*peer);
}

TEST_F(DdsPeer, OwnBestEffortWritersAreNotWantedByReliableReaders) {
    bus.advertise(cloud, kBestEffort);
    const auto peer = start("subscribe");
    ASSERT_TRUE(eventually([&] { return !peer->said("incompatible").empty(); }));
    EXPECT_FALSE(bus.is_wanted("/points"));
}

TEST_F(DdsPeer, WritersOfOtherQualityAreReceived) {
    bus.subscribe(cloud, kReliable, inbox.receive());
    for (const char* option : {"deadline=0.5", "lease=5", "depth=0", "latched=1", "xcdr2=1"}) {
        const std::size_t before = inbox.size();
        const auto peer = start("publish", {option});
        ASSERT_TRUE(eventually([&] {
            peer->write("1 1000 5000\n");
            return eventually([&] { return inbox.size() > before; }, 0.2);
        })) << option;
    }
}

TEST_F(DdsPeer, OtherPartitionsAreSeenButNotReceived) {
    bus.subscribe(cloud, kReliable, inbox.receive());
    const auto peer = start("publish", {"partition=robot1"});
    ASSERT_TRUE(eventually([&] { return bus.seen().size() == 1; }));
    peer->write("20 100 100\n");
    ASSERT_TRUE(eventually([&] { return !peer->said("done").empty(); }));
    EXPECT_EQ(inbox.size(), 0U);
}

TEST_F(DdsPeer, PeersMayDieAndComeBack) {
    bus.subscribe(cloud, kReliable, inbox.receive());
    bus.advertise({"/map", cloud.type, cloud.encoding}, kLatched);
    bus.publish("/map", 0.0, random_message(1000, 7));
    for (int round = 0; round < 10; ++round) {
        const std::size_t before = inbox.size();
        const auto publisher = start("publish"),
                   subscriber = start("subscribe", {"latched=1", "topic=rt/map"});
        ASSERT_TRUE(eventually([&] {
            publisher->write("1 1000 300000\n");
            return eventually([&] { return inbox.size() > before; }, 0.2);
        })) << round;
        ASSERT_TRUE(eventually([&] { return !subscriber->said("got").empty(); })) << round;
        publisher->write("1000 1000 300000\n");
        publisher->kill_now();
        subscriber->kill_now();
        publisher->wait();
        subscriber->wait();
    }
    for (const Bytes& message : inbox.messages()) {
        EXPECT_TRUE(message->size() == 300000) << "only whole messages arrive";
    }
}

TEST_F(DdsPeer, LeavingPeersAreNoLongerSeen) {
    auto peer = start("publish");
    ASSERT_TRUE(eventually([&] { return bus.seen().size() == 1; }));
    peer->end_input();
    EXPECT_EQ(peer->wait(), 0);
    EXPECT_TRUE(eventually([&] { return bus.seen().empty(); }));
}

TEST_F(DdsPeer, OnePacketOfTenMayBeLost) {
    const auto peer = start("publish", {"depth=0", "loss=10"});
    bus.subscribe(cloud, kReliable, inbox.receive());
    expect_exact(*peer, 20, "50 1000000");
}

TEST_F(DdsPeer, ServicesAreCalledAndAnswered) {
    std::atomic<int> calls = 0;
    bus.serve("/filter/reset", kTrigger, [&](io::MessageReader&, io::MessageWriter& out) {
        write(out, {.success = true, .message = "call " + std::to_string(++calls)});
    });
    const std::string type = "std_srvs::srv::dds_::Trigger_";
    const auto answers =
        start("decode", {"topic=rr/filter/resetReply", "type=" + type + "Response_"});
    const auto client =
        start("relay", {"topic=rq/filter/resetRequest", "type=" + type + "Request_"});
    ASSERT_TRUE(eventually([&] { return answers->said("publishers") == std::vector{"1"s}; }));
    const auto ask = [&](std::int64_t number) {
        io::MessageWriter request(io::MessageEncoding::cdr);
        request.number(std::uint64_t{12345678901234567890U});
        request.number(number);
        request.number(std::uint8_t{0});  // C++ and IDL know no empty structure
        const std::vector<std::byte> message = request.moved_bytes();
        const auto size = static_cast<std::uint32_t>(message.size());
        client->write(std::as_bytes(std::span(&size, 1)));
        client->write(message);
    };
    ASSERT_TRUE(eventually([&] {  // until both sides have found each other
        ask(1);
        return eventually([&] { return calls > 0; }, 0.2);
    }));
    const int before = calls;
    ask(7);
    ASSERT_TRUE(eventually([&] { return calls == before + 1; }));
    const std::string expected =
        "12345678901234567890 7 1 \"call " + std::to_string(before + 1) + "\" left 0";
    EXPECT_TRUE(eventually([&] {
        const auto got = answers->said("got");
        return !got.empty() && got.back().starts_with(expected.substr(0, expected.size() - 1));
    })) << answers->said("got").back();
}

struct LossyDdsPeer : DdsPeer {
    LossyDdsPeer() : DdsPeer(true) {}
    ~LossyDdsPeer() override { unsetenv("CYCLONEDDS_URI"); }
};

TEST_F(LossyDdsPeer, OneOwnPacketOfTenMayBeLost) {
    bus.advertise(cloud, kReliable);
    const auto peer = start("subscribe", {"depth=0"});
    connect_to(*peer);
    publish_and_expect_exact(*peer, 20, {1000000});
}

}  // namespace dds_peer_test
}  // namespace dynamic_filter::live
