// SPDX-License-Identifier: MIT
#include "live/foxglove_server.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <thread>

#include "dynamic_filter/error.hpp"
#include "live/websocket_client.hpp"

namespace dynamic_filter::live {
namespace foxglove_server_test {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

bool eventually(const std::function<bool()>& what, double seconds = 20.0) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
        if (what()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return what();
}

Bytes bytes_of(std::size_t size, unsigned seed) {
    auto bytes = std::make_shared<std::vector<std::byte>>(size);
    for (std::size_t i = 0; i < size; ++i) {
        (*bytes)[i] = static_cast<std::byte>((seed + i * 7 + (i >> 8)) & 0xFF);
    }
    return bytes;
}

std::string text_of(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

json next_text(WebSocketClient& client) {
    const Frame frame = client.next();
    EXPECT_EQ(frame.kind, 1);
    return json::parse(frame.payload, nullptr, false);
}

struct Data {
    std::uint32_t subscription = 0;
    std::uint64_t time = 0;
    std::string bytes;
};

Data next_data(WebSocketClient& client) {
    const Frame frame = client.next();
    EXPECT_EQ(frame.kind, 2);
    Data data;
    if (frame.payload.size() < 13 || frame.payload[0] != 1) return data;
    std::memcpy(&data.subscription, frame.payload.data() + 1, 4);
    std::memcpy(&data.time, frame.payload.data() + 5, 8);
    data.bytes = frame.payload.substr(13);
    return data;
}

/// The connection, after serverInfo; returns the channels.
json channels_of(WebSocketClient& client) {
    EXPECT_TRUE(client.open());
    EXPECT_EQ(next_text(client)["op"], "serverInfo");
    return next_text(client)["channels"];
}

void subscribe(WebSocketClient& client, unsigned id, unsigned channel) {
    client.say_text(fmt::format(
        R"({{"op":"subscribe","subscriptions":[{{"id":{},"channelId":{}}}]}})", id, channel));
}

const io::Topic kCloud{"/points", "sensor_msgs/PointCloud2", io::MessageEncoding::cdr};
const io::Topic kMap{"/map", "sensor_msgs/PointCloud2", io::MessageEncoding::cdr};

struct Server : testing::Test {
    // Many clients, because those that left are noticed a little later.
    FoxgloveServer server{io::MessageEncoding::cdr, {.port = 0, .origins = {}, .clients = 100}};
    std::unique_ptr<WebSocketClient> client() const {
        return std::make_unique<WebSocketClient>(server.port());
    }
    /// A client that gets /points as subscription 1.
    std::unique_ptr<WebSocketClient> subscriber(int receive_buffer = 0) const {
        auto made = std::make_unique<WebSocketClient>(server.port(), receive_buffer);
        const json channels = channels_of(*made);
        subscribe(*made, 1, channels.at(0).at("id"));
        made->say_text("?");  // its answer comes after the subscription
        EXPECT_EQ(next_text(*made)["op"], "status");
        return made;
    }
    /// Some other client still gets what it asks for.
    void expect_alive() const {
        WebSocketClient other(server.port());
        EXPECT_TRUE(channels_of(other).is_array());
        other.say_text("?");
        EXPECT_EQ(next_text(other)["op"], "status");
    }
};

TEST_F(Server, ListsTopicsAndSendsMessages) {
    server.advertise(kCloud, {});
    EXPECT_FALSE(server.is_wanted("/points"));
    WebSocketClient client(server.port());
    const json channels = channels_of(client);
    ASSERT_EQ(channels.size(), 1U);
    EXPECT_EQ(channels[0]["topic"], "/points");
    EXPECT_EQ(channels[0]["schemaName"], "sensor_msgs/msg/PointCloud2");
    EXPECT_EQ(server.clients(), 1U);
    EXPECT_TRUE(server.publish("/points", 1.0, bytes_of(10, 0))) << "nobody wants it";
    subscribe(client, 9, channels[0]["id"]);
    ASSERT_TRUE(eventually([&] { return server.is_wanted("/points"); }));
    for (const std::size_t size : {0UL, 1UL, 100UL, 65523UL, 65524UL, 200000UL, 7000001UL}) {
        const Bytes sent = bytes_of(size, static_cast<unsigned>(size));
        ASSERT_TRUE(server.publish("/points", 1700000000.25, sent));
        const Data data = next_data(client);
        EXPECT_EQ(data.subscription, 9U);
        EXPECT_EQ(data.time, 1700000000250000000U);
        EXPECT_TRUE(data.bytes == text_of(sent)) << size;
    }
    client.say_text(R"({"op":"unsubscribe","subscriptionIds":[9]})");
    EXPECT_TRUE(eventually([&] { return !server.is_wanted("/points"); }));
    EXPECT_EQ(server.url(), fmt::format("ws://127.0.0.1:{}", server.port()));
}

TEST_F(Server, BothNamesOfTheProtocolAreKnown) {
    for (const char* name : {"foxglove.websocket.v1", "foxglove.sdk.v1"}) {
        WebSocketClient client(server.port());
        const std::string answer = client.ask(WebSocketClient::handshake("", name));
        EXPECT_NE(answer.find(std::string("Sec-WebSocket-Protocol: ") + name + "\r\n"),
                  std::string::npos)
            << answer;
        // From RFC 6455, for the key that all clients here send.
        EXPECT_NE(answer.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos) << answer;
        EXPECT_EQ(next_text(client)["op"], "serverInfo");
    }
}

TEST_F(Server, MessagesOfRos1AreNamedAsSuch) {
    FoxgloveServer ros1(io::MessageEncoding::ros1, {.port = 0, .origins = {}});
    ros1.advertise(kCloud, {});
    WebSocketClient client(ros1.port());
    const json channels = channels_of(client);
    EXPECT_EQ(channels[0]["encoding"], "ros1");
    EXPECT_EQ(channels[0]["schemaName"], "sensor_msgs/PointCloud2");
}

TEST_F(Server, LaterTopicsAreListedOnce) {
    WebSocketClient client(server.port());
    EXPECT_EQ(channels_of(client), json::array());
    server.advertise(kCloud, {});
    server.advertise(kCloud, {.depth = 1});
    server.advertise(kMap, {.latched = true});
    const json first = next_text(client), second = next_text(client);
    EXPECT_EQ(first["channels"][0]["topic"], "/points");
    EXPECT_EQ(second["channels"][0]["topic"], "/map");
    EXPECT_NE(first["channels"][0]["id"], second["channels"][0]["id"]);
    EXPECT_THROW(server.advertise({"/map", "nav_msgs/Path"}, {}), Error);
    EXPECT_THROW(server.advertise({"/x", "unknown_msgs/Type"}, {}), Error);
    EXPECT_FALSE(server.publish("/x", 0.0, bytes_of(1, 0))) << "it is not advertised";
}

TEST_F(Server, LateSubscribersGetTheLastLatchedMessage) {
    server.advertise(kMap, {.latched = true, .depth = 1});
    for (unsigned i = 0; i < 3; ++i) server.publish("/map", i, bytes_of(1000, i));
    WebSocketClient client(server.port());
    subscribe(client, 3, channels_of(client)[0]["id"]);
    const Data data = next_data(client);
    EXPECT_EQ(data.subscription, 3U);
    EXPECT_EQ(data.time, 2000000000U);
    EXPECT_EQ(data.bytes, text_of(bytes_of(1000, 2)));
}

TEST_F(Server, ASlowClientMissesTheOldestAndHoldsNobodyUp) {
    server.advertise(kCloud, {.depth = 3});
    const auto slow = subscriber(65536), fast = subscriber();
    constexpr unsigned kMessages = 50;
    const auto start = Clock::now();
    for (unsigned i = 0; i < kMessages; ++i) {
        const Bytes sent = bytes_of(1000000, i);
        EXPECT_TRUE(server.publish("/points", i, sent));
        ASSERT_TRUE(next_data(*fast).bytes == text_of(sent)) << i;
    }
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(30));
    std::vector<std::uint64_t> times;
    while (times.empty() || times.back() != (kMessages - 1) * 1000000000ULL) {
        const Data data = next_data(*slow);
        ASSERT_EQ(data.bytes.size(), 1000000U);
        times.push_back(data.time);
    }
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    EXPECT_LT(times.size(), kMessages / 2);
    ASSERT_GE(times.size(), 3U);
    EXPECT_EQ(times[times.size() - 3], (kMessages - 3) * 1000000000ULL) << "the newest are kept";
}

TEST(FoxgloveServer, LimitsWhatWaitsForAClient) {
    FoxgloveServer server(io::MessageEncoding::cdr,
                          {.port = 0, .origins = {}, .client_bytes = 2500000});
    server.advertise(kCloud, {.depth = 1000});
    WebSocketClient slow(server.port(), 65536);
    subscribe(slow, 1, channels_of(slow)[0]["id"]);
    ASSERT_TRUE(eventually([&] { return server.is_wanted("/points"); }));
    for (unsigned i = 0; i < 40; ++i) {
        EXPECT_TRUE(server.publish("/points", i, bytes_of(1000000, i)));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(server.publish("/points", 40.0, bytes_of(3000000, 0))) << "alone it may be larger";
    Data data;
    unsigned count = 0;
    while (data.time != 40000000000U && ++count < 40) data = next_data(slow);
    EXPECT_LT(count, 10U) << "two may wait, and few are on their way";
    EXPECT_EQ(data.bytes.size(), 3000000U);
}

TEST_F(Server, WrongRequestsGetAStatus) {
    server.advertise(kCloud, {});
    WebSocketClient client(server.port());
    const unsigned channel = channels_of(client)[0]["id"];
    const auto expect = [&](int level, const std::string& words) {
        const json answer = next_text(client);
        EXPECT_EQ(answer["op"], "status");
        EXPECT_EQ(answer["level"], level);
        EXPECT_NE(answer["message"].get<std::string>().find(words), std::string::npos) << answer;
    };
    client.say_text("{");
    expect(2, "JSON");
    client.say_text(R"({"op":"advertise","channels":[{"id":1,"topic":"/cmd_vel"}]})");
    expect(1, "advertise");
    client.say_text(R"({"op":"getParameters"})");
    expect(1, "getParameters");
    client.say_frame(2, std::string("\x01\x00\x00\x00\x00hello", 10));
    expect(1, "binary");
    client.say_frame(1, "\xFF\xFE");
    expect(2, "JSON");
    subscribe(client, 1, 77);
    expect(2, "channel 77");
    subscribe(client, 1, channel);
    subscribe(client, 2, channel);
    expect(2, "subscribed already");
    client.say_text(R"({"op":"unsubscribe","subscriptionIds":[5]})");
    expect(1, "no subscription 5");
    EXPECT_TRUE(server.is_wanted("/points")) << "the good request among them counts";
}

TEST_F(Server, RequestsMayComeInPieces) {
    server.advertise(kCloud, {});
    WebSocketClient client(server.port());
    EXPECT_EQ(channels_of(client).size(), 1U);
    client.say_frame(1, R"({"op":"subscribe",)", false);
    client.say_frame(9, "ping");
    client.say_frame(0, R"("subscriptions":[{"id":1,"channelId":1}]})");
    EXPECT_TRUE(eventually([&] { return server.is_wanted("/points"); }));
}

TEST_F(Server, HugeRequestsEndTheConnection) {
    server.advertise(kCloud, {});
    const auto expect_end = [](WebSocketClient& client) {
        Frame last;
        while ((last = client.next()).kind == 1) {
        }
        EXPECT_EQ(last.kind, 8);
        EXPECT_EQ(last.payload, "\x03\xF1");  // 1009: too large
    };
    {
        const auto client = subscriber();
        client->say_frame(1, std::string(1000, ' '), true, std::uint64_t{1} << 32U);
        expect_end(*client);
        EXPECT_TRUE(eventually([&] { return !server.is_wanted("/points"); }));
    }
    {
        const auto client = subscriber();
        for (int i = 0; i < 20; ++i)
            client->say_frame(i == 0 ? 1 : 0, std::string(5000, ' '), false);
        expect_end(*client);
    }
    EXPECT_TRUE(eventually([&] { return server.clients() == 0; }));
    expect_alive();
}

TEST_F(Server, AClientThatComplainsWithoutReadingFillsNoMemory) {
    WebSocketClient client(server.port(), 4096);
    ASSERT_TRUE(client.open());
    for (int i = 0; i < 20000; ++i) client.say_frame(1, "?");
    expect_alive();
}

TEST_F(Server, StrangeWebPagesAreRefusedAndReported) {
    for (int i = 0; i < 3; ++i) {
        const std::string answer =
            client()->ask(WebSocketClient::handshake("Origin: https://evil.example\r\n"));
        EXPECT_TRUE(answer.starts_with("HTTP/1.1 403 ")) << answer;
    }
    const auto notices = server.pop_notices();
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_NE(notices[0].find("https://evil.example"), std::string::npos);
    EXPECT_TRUE(server.pop_notices().empty());
    EXPECT_TRUE(client()->open("Origin: http://localhost:8080\r\n"));
    EXPECT_TRUE(client()->open("Origin: https://app.foxglove.dev\r\n"));
    FoxgloveServer own(io::MessageEncoding::cdr, {.port = 0, .origins = {"https://robot.example"}});
    EXPECT_TRUE(WebSocketClient(own.port()).open("Origin: https://robot.example\r\n"));
}

TEST_F(Server, OtherRequestsAreRefused) {
    const std::string page = client()->ask("GET / HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_TRUE(page.starts_with("HTTP/1.1 426 ")) << page;
    EXPECT_TRUE(client()->ask("\r\n\r\n").starts_with("HTTP/1.1 400 "));
    EXPECT_TRUE(client()
                    ->ask("GET / HTTP/1.1\r\nX: " + std::string(20000, 'x'))
                    .starts_with("HTTP/1.1 431 "));
    // No client speaks before it was answered.
    EXPECT_TRUE(client()->ask(WebSocketClient::handshake() + "more").starts_with("HTTP/1.1 400 "));
    expect_alive();
}

TEST(FoxgloveServer, TooManyClientsAreRefused) {
    const FoxgloveServer server(io::MessageEncoding::cdr, {.port = 0, .origins = {}, .clients = 2});
    auto first = std::make_unique<WebSocketClient>(server.port());
    WebSocketClient second(server.port());
    ASSERT_TRUE(first->open());
    ASSERT_TRUE(second.open());
    const std::string answer = WebSocketClient(server.port()).ask(WebSocketClient::handshake());
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 503 ")) << answer;
    EXPECT_EQ(server.clients(), 2U);
    first.reset();
    EXPECT_TRUE(eventually([&] { return WebSocketClient(server.port()).open(); }));
}

TEST_F(Server, SilentClientsAreGivenUp) {
    std::vector<std::unique_ptr<WebSocketClient>> silent;
    for (int i = 0; i < 100; ++i) {
        silent.push_back(client());
        silent.back()->say("GET / HT");
    }
    EXPECT_TRUE(eventually([&] { return client()->open(); }));
    EXPECT_TRUE(client()->open());
}

/// Sooner than the time that a client has for its handshake.
TEST_F(Server, ClientsThatNeverFinishTheirHandshakeKeepNobodyOut) {
    std::vector<std::unique_ptr<WebSocketClient>> silent;
    for (int i = 0; i < 300; ++i) {
        silent.push_back(client());
        silent.back()->say("GET / HT");
    }
    const auto start = Clock::now();
    EXPECT_TRUE(client()->open());
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(4));
}

TEST(FoxgloveServer, APortInUseIsAClearError) {
    const FoxgloveServer first(io::MessageEncoding::cdr, {.port = 0, .origins = {}});
    try {
        const FoxgloveServer second(io::MessageEncoding::cdr,
                                    {.port = first.port(), .origins = {}});
        FAIL();
    } catch (const OutputError& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find(fmt::format("127.0.0.1:{}", first.port())), std::string::npos) << what;
        EXPECT_NE(what.find("choose another foxglove.port"), std::string::npos) << what;
    }
    EXPECT_THROW(FoxgloveServer(io::MessageEncoding::cdr,
                                {.address = "192.0.2.1", .port = 0, .origins = {}}),
                 OutputError);
    EXPECT_THROW(FoxgloveServer(io::MessageEncoding::cdr,
                                {.address = "no address", .port = 0, .origins = {}}),
                 OutputError);
}

/// But for eventfds: libwebsockets 4.3 leaves that of each of its contexts open.
std::size_t open_files() {
    const std::filesystem::directory_iterator files("/proc/self/fd");
    return static_cast<std::size_t>(std::count_if(begin(files), end(files), [](const auto& file) {
        std::error_code closed_meanwhile;
        const auto target = std::filesystem::read_symlink(file.path(), closed_meanwhile);
        return target != "anon_inode:[eventfd]";
    }));
}

TEST(FoxgloveServer, EndsSoonAndLeavesNoFilesOpen) {
    const std::size_t before = open_files();
    for (int i = 0; i < 3; ++i) {
        auto server = std::make_unique<FoxgloveServer>(io::MessageEncoding::cdr,
                                                       FoxgloveOptions{.port = 0, .origins = {}});
        server->advertise(kCloud, {});
        WebSocketClient slow(server->port(), 4096), silent(server->port());
        WebSocketClient refused(server->port());
        EXPECT_TRUE(refused.ask("\r\n\r\n").starts_with("HTTP/1.1 400 "));
        subscribe(slow, 1, channels_of(slow)[0]["id"]);
        ASSERT_TRUE(eventually([&] { return server->is_wanted("/points"); }));
        for (int k = 0; k < 5; ++k) server->publish("/points", 0.0, bytes_of(5000000, 0));
        const auto start = Clock::now();
        server.reset();
        EXPECT_LT(Clock::now() - start, std::chrono::seconds(5));
    }
    EXPECT_EQ(open_files(), before);
}

TEST_F(Server, ClientsComeAndGoWhileThreadsPublish) {
    server.advertise(kCloud, {});
    std::atomic<bool> stop = false;
    std::vector<std::thread> threads;
    for (unsigned k = 0; k < 2; ++k) {
        threads.emplace_back([&, k] {
            for (unsigned i = 0; !stop; ++i) {
                server.publish("/points", i, bytes_of(i % 3 == 0 ? 300000 : 100, k));
                server.advertise({fmt::format("/t{}", i % 20), "nav_msgs/Path"}, {});
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        });
    }
    for (int i = 0; i < 60; ++i) {
        WebSocketClient client(server.port());
        subscribe(client, 1, [&] {
            for (const json& channel : channels_of(client)) {
                if (channel["topic"] == "/points") return channel["id"].get<unsigned>();
            }
            return 0U;
        }());
        Frame frame;
        for (int seen = 0; i % 2 == 0 && seen < 3 && (frame = client.next()).kind != 0;) {
            seen += frame.kind == 2 ? 1 : 0;
        }
        EXPECT_EQ(frame.kind, i % 2 == 0 ? 2 : 0);
    }
    stop = true;
    for (std::thread& thread : threads) thread.join();
    EXPECT_TRUE(eventually([&] { return server.clients() == 0; }));
}

std::string random_bytes(std::mt19937& random, std::size_t most) {
    std::string bytes(random() % (most + 1), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    return bytes;
}

std::string changed(std::string bytes, std::mt19937& random) {
    for (unsigned changes = random() % 4; changes-- > 0;) {
        bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    return bytes;
}

/// Frames after which the connection may go on.
void say_anything(WebSocketClient& client, std::mt19937& random) {
    const std::string request =
        fmt::format(R"({{"op":"{}subscribe","subscriptions":[{{"id":{},"channelId":{}}}]}})",
                    random() % 4 == 0 ? "un" : "", random() % 3, random() % 3);
    switch (random() % 5) {
        case 0:
            return client.say_frame(9, random_bytes(random, 125));
        case 1:
            return client.say_frame(2, random_bytes(random, 5000));
        case 2: {
            client.say_frame(1, random_bytes(random, 300), false);
            if (random() % 2 == 0) client.say_frame(10, random_bytes(random, 125));
            return client.say_frame(0, random_bytes(random, 300));
        }
        default:
            return client.say_frame(1, changed(request, random));
    }
}

/// Frames after which it must end, or that the server waits for in vain.
void say_nonsense(WebSocketClient& client, std::mt19937& random) {
    if (random() % 2 == 0) return client.say(random_bytes(random, 300));
    client.say_frame(static_cast<int>(random() % 128), random_bytes(random, 300), random() % 2 == 0,
                     std::uint64_t{random()} << (random() % 33U));
}

TEST_F(Server, RandomFramesDoNoHarm) {
    server.advertise(kCloud, {});
    server.advertise(kMap, {.latched = true});
    std::mt19937 random(7);
    for (int connection = 0; connection < 300; ++connection) {
        WebSocketClient client(server.port());
        server.publish("/points", 1.0, bytes_of(50000, 1));
        server.publish("/map", 1.0, bytes_of(50000, 1));
        if (connection % 10 == 0) {
            client.say(connection % 20 == 0 ? random_bytes(random, 3000)
                                            : changed(WebSocketClient::handshake(), random));
            continue;
        }
        ASSERT_TRUE(client.open());
        for (int i = 0; i < 20; ++i) say_anything(client, random);
        for (int i = 0; i < 3; ++i) say_nonsense(client, random);
    }
    EXPECT_TRUE(eventually([&] { return server.clients() == 0; }));
    expect_alive();
}

}  // namespace foxglove_server_test
}  // namespace dynamic_filter::live
