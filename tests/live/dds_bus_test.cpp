// SPDX-License-Identifier: MIT
#include "live/dds_bus.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "live/dds_support.hpp"

namespace dynamic_filter::live {
namespace dds_bus_test {

Bytes bytes_of(std::size_t size, unsigned seed) {
    auto bytes = std::make_shared<std::vector<std::byte>>(size);
    std::mt19937 random(seed);
    for (std::byte& b : *bytes) b = static_cast<std::byte>(random());
    // A CDR header in little endian.
    for (std::size_t i = 0; i < 4; ++i) (*bytes)[i] = static_cast<std::byte>(i == 1 ? 1 : 0);
    return bytes;
}

TEST(DdsBus, NamesOnTheWire) {
    EXPECT_EQ(dds_topic_name("/a/points"), "rt/a/points");
    EXPECT_EQ(dds_topic_name("points"), "rt/points");
    EXPECT_EQ(dds_type_name("sensor_msgs/PointCloud2"), "sensor_msgs::msg::dds_::PointCloud2_");
    EXPECT_EQ(topic_of_dds("rt/a/points"), "/a/points");
    EXPECT_EQ(topic_of_dds("rq/service"), "");
    EXPECT_EQ(type_of_dds("sensor_msgs::msg::dds_::PointCloud2_"), "sensor_msgs/PointCloud2");
    for (const char* other : {"", "PointCloud2", "a::srv::dds_::B_Request_", "a::msg::dds_::B"}) {
        EXPECT_EQ(type_of_dds(other), "") << other;
    }
}

TEST(DdsBus, RefusesWrongOptions) {
    EXPECT_THROW(DdsBus({.domain = 233, .network = {}}), ConfigError);
    EXPECT_THROW(DdsBus({.domain = -1, .network = {}}), ConfigError);
    EXPECT_THROW(DdsBus({.domain = 92, .network = "<eth0>"}), ConfigError);
    try {
        DdsBus({.domain = 92, .network = "nosuchdevice"});
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("nosuchdevice: does not match"), std::string::npos)
            << e.what();
    }
}

TEST(DdsBus, EveryDomainCanBeJoined) {
    for (const int domain : {1, 231, 232}) {
        EXPECT_NO_THROW(DdsBus({.domain = domain, .network = "localhost"})) << domain;
    }
}

TEST(DdsBus, BusesOfAProcessShareADomain) {
    const ReservedDomain domain;
    const DdsOptions options{.domain = domain.number(), .network = "localhost"};
    const io::Topic topic{"/points", "sensor_msgs/PointCloud2", io::MessageEncoding::cdr};
    auto first = std::make_unique<DdsBus>(options);
    DdsBus second(options);
    first.reset();
    DdsBus third(options);
    Inbox inbox;
    third.subscribe(topic, {}, inbox.receive());
    second.advertise(topic, {});
    ASSERT_TRUE(eventually([&] { return second.is_wanted("/points"); }));
    second.publish("/points", 0.0, bytes_of(100, 1));
    EXPECT_TRUE(eventually([&] { return inbox.size() == 1; }));
}

/// Two participants in this process exchange messages as two processes do, but for the network.
struct TwoBuses : testing::Test {
    ReservedDomain domain;
    DdsBus a{{.domain = domain.number(), .network = "localhost"}};
    DdsBus b{{.domain = domain.number(), .network = "localhost"}};
    io::Topic cloud{"/points", "sensor_msgs/PointCloud2", io::MessageEncoding::cdr};
};

TEST_F(TwoBuses, MessagesOfAllSizesArrive) {
    Inbox inbox;
    b.subscribe(cloud, {.reliable = true, .latched = false, .depth = 20}, inbox.receive());
    a.advertise(cloud, {.reliable = true, .latched = false, .depth = 20});
    ASSERT_TRUE(eventually([&] { return a.is_wanted("/points"); }));
    std::vector<Bytes> sent;
    for (const std::size_t size : {4UL, 5UL, 7UL, 100UL, 65000UL, 1000001UL, 4000003UL}) {
        sent.push_back(bytes_of(size, static_cast<unsigned>(size)));
        ASSERT_TRUE(a.publish("/points", 0.0, sent.back())) << size;
    }
    ASSERT_TRUE(eventually([&] { return inbox.size() == sent.size(); })) << inbox.size();
    for (std::size_t i = 0; i < sent.size(); ++i) {
        auto padded = *sent[i];
        padded.resize((padded.size() + 3) / 4 * 4);
        EXPECT_EQ(*inbox.messages()[i], padded);
    }
    EXPECT_EQ(b.lost(), 0U);
}

TEST_F(TwoBuses, PublishersAreSeenWithWhatTheyOffer) {
    EXPECT_TRUE(b.seen().empty());
    a.advertise(cloud, {.reliable = false, .latched = false, .depth = 5});
    a.advertise({"/tf_static", "tf2_msgs/TFMessage", io::MessageEncoding::cdr},
                {.reliable = true, .latched = true, .depth = 1});
    ASSERT_TRUE(eventually([&] { return b.seen().size() == 2; }));
    const auto seen = b.seen();
    EXPECT_EQ(seen[0].name, "/points");
    EXPECT_EQ(seen[0].type, "sensor_msgs/PointCloud2");
    EXPECT_EQ(seen[0].publishers, 1U);
    EXPECT_FALSE(seen[0].offered.reliable);
    EXPECT_TRUE(seen[1].offered.reliable);
    EXPECT_TRUE(seen[1].offered.latched);
    EXPECT_TRUE(a.seen().empty()) << "the own publishers are not listed";
}

TEST_F(TwoBuses, LateSubscribersGetTheLastLatchedMessage) {
    const Quality latched{.reliable = true, .latched = true, .depth = 1};
    a.advertise(cloud, latched);
    for (unsigned i = 0; i < 3; ++i) ASSERT_TRUE(a.publish("/points", 0.0, bytes_of(1000, i)));
    Inbox inbox;
    b.subscribe(cloud, latched, inbox.receive());
    ASSERT_TRUE(eventually([&] { return inbox.size() == 1; }));
    EXPECT_EQ(*inbox.messages()[0], *bytes_of(1000, 2));
}

TEST_F(TwoBuses, SubscriptionsCanBeReplaced) {
    Inbox reliable, any;
    a.advertise(cloud, {.reliable = false, .latched = false, .depth = 5});
    b.subscribe(cloud, {.reliable = true, .latched = false, .depth = 5}, reliable.receive());
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_FALSE(a.is_wanted("/points")) << "it offers less than the reader asks for";
    b.subscribe(cloud, {.reliable = false, .latched = false, .depth = 5}, any.receive());
    ASSERT_TRUE(eventually([&] { return a.is_wanted("/points"); }));
    ASSERT_TRUE(eventually([&] {
        a.publish("/points", 0.0, bytes_of(100, 1));
        return any.size() > 0;
    }));
    EXPECT_EQ(reliable.size(), 0U);
}

TEST_F(TwoBuses, ASlowReceiverHoldsNobodyUp) {
    const auto go = std::make_shared<std::atomic<bool>>(false);
    b.subscribe(cloud, {.reliable = true, .latched = false, .depth = 2},
                [go](const io::Topic&, const Bytes&) { eventually([&] { return go->load(); }); });
    a.advertise(cloud, {.reliable = true, .latched = false, .depth = 2});
    ASSERT_TRUE(eventually([&] { return a.is_wanted("/points"); }));
    const auto start = std::chrono::steady_clock::now();
    for (unsigned i = 0; i < 50; ++i) a.publish("/points", 0.0, bytes_of(1000000, i));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    *go = true;
}

TEST_F(TwoBuses, WhatIsNoMessageIsNotPublished) {
    a.advertise(cloud, {});
    EXPECT_FALSE(a.publish("/points", 0.0, nullptr));
    EXPECT_FALSE(a.publish("/points", 0.0, std::make_shared<const std::vector<std::byte>>(3)));
    EXPECT_FALSE(a.publish("/other", 0.0, bytes_of(100, 1))) << "it is not advertised";
}

/// For the thread sanitizer: all members at once, while messages come.
TEST_F(TwoBuses, MembersMayBeCalledFromManyThreads) {
    std::atomic<int> received = 0;
    std::atomic<bool> done = false;
    const auto count = [&](const io::Topic&, const Bytes&) { ++received; };
    a.advertise(cloud, {});
    std::vector<std::thread> threads;
    const auto repeat = [&](std::function<void()> what) {
        threads.emplace_back([&done, what = std::move(what)] {
            while (!done) what();
        });
    };
    repeat([&, message = bytes_of(10000, 1)] { a.publish("/points", 0.0, message); });
    repeat([&] { b.subscribe(cloud, {}, count); });
    repeat([&] { b.subscribe({"/other", cloud.type, cloud.encoding}, {}, count); });
    repeat([&] { a.advertise({"/other", cloud.type, cloud.encoding}, {}); });
    repeat([&] { a.publish("/other", 0.0, bytes_of(100, 1)); });
    repeat([&] {
        (void)b.lost();
        (void)b.seen();
        (void)a.is_wanted("/points");
        (void)b.pop_notices();
    });
    EXPECT_TRUE(eventually([&] { return received > 100; }));
    done = true;
    for (std::thread& thread : threads) thread.join();
    // The callback must not outlive what it counts.
    b.subscribe(cloud, {}, [](const io::Topic&, const Bytes&) {});
    b.subscribe({"/other", cloud.type, cloud.encoding}, {}, [](const io::Topic&, const Bytes&) {});
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace dds_bus_test
}  // namespace dynamic_filter::live
