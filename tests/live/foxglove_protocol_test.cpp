// SPDX-License-Identifier: MIT
#include "live/foxglove_protocol.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dynamic_filter::live {
namespace foxglove_protocol_test {

using nlohmann::json;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST(FoxgloveProtocol, TheServerOffersNothingButTopics) {
    const json info = json::parse(server_info("abc"));
    EXPECT_EQ(info["op"], "serverInfo");
    EXPECT_EQ(info["name"], "DynamicFilter");
    EXPECT_EQ(info["sessionId"], "abc");
    EXPECT_EQ(info["capabilities"], json::array());
    EXPECT_EQ(info["supportedEncodings"], json::array());
    EXPECT_TRUE(info["metadata"]["version"].is_string());
}

TEST(FoxgloveProtocol, ChannelsHaveTheDefinitionsOfTheirEncoding) {
    for (const auto encoding : {io::MessageEncoding::ros1, io::MessageEncoding::cdr}) {
        const bool ros1 = encoding == io::MessageEncoding::ros1;
        json told =
            json::parse(advertisement({{7, {"/points", "sensor_msgs/PointCloud2", encoding}}}));
        EXPECT_EQ(told["op"], "advertise");
        ASSERT_EQ(told["channels"].size(), 1U);
        const std::string schema = told["channels"][0]["schema"];
        EXPECT_TRUE(schema.starts_with("std_msgs/Header header\nuint32 height\n")) << schema;
        EXPECT_NE(schema.find(ros1 ? "\ntime stamp\n" : "\nbuiltin_interfaces/Time stamp\n"),
                  std::string::npos);
        told["channels"][0].erase("schema");
        const json expected{
            {"id", 7},
            {"topic", "/points"},
            {"encoding", ros1 ? "ros1" : "cdr"},
            {"schemaName", ros1 ? "sensor_msgs/PointCloud2" : "sensor_msgs/msg/PointCloud2"},
            {"schemaEncoding", ros1 ? "ros1msg" : "ros2msg"}};
        EXPECT_EQ(told["channels"][0], expected);
    }
    EXPECT_EQ(json::parse(advertisement({}))["channels"], json::array());
}

TEST(FoxgloveProtocol, StatusesMayQuoteAnyBytes) {
    EXPECT_EQ(json::parse(status(FoxgloveLevel::warning, "a")),
              (json{{"op", "status"}, {"level", 1}, {"message", "a"}}));
    EXPECT_EQ(json::parse(status(FoxgloveLevel::error, "\xFF\"")).at("message"), "\xEF\xBF\xBD\"");
}

TEST(FoxgloveProtocol, MessagesStartWithSubscriptionAndTime) {
    EXPECT_EQ(message_head(0x01020304, 0x0102030405060708),
              std::string("\x01\x04\x03\x02\x01\x08\x07\x06\x05\x04\x03\x02\x01", 13));
}

TEST(FoxgloveProtocol, RequestsAreUnderstood) {
    const auto subscribed = parse_request(
        R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":5}]})");
    EXPECT_EQ(subscribed.subscribe, (Pairs{{0, 3}, {4294967295U, 5}}));
    EXPECT_EQ(subscribed.wrong + subscribed.unsupported, "");
    const auto ended = parse_request(R"({"op":"unsubscribe","subscriptionIds":[0,1]})");
    EXPECT_EQ(ended.unsubscribe, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(ended.wrong + ended.unsupported, "");
    EXPECT_EQ(parse_request(R"({"op":"advertise","channels":[]})").unsupported, "advertise");
    EXPECT_EQ(parse_request(R"({"op":""})").unsupported, "a nameless request");
}

TEST(FoxgloveProtocol, WrongRequestsAreExplained) {
    for (const char* text :
         {"", "[", "1", "null", "{}", "[1]", R"("op")", R"({"op":1})", R"({"op":"subscribe"})",
          R"({"op":"subscribe","subscriptions":{"id":1,"channelId":1}})",
          R"({"op":"subscribe","subscriptions":[1]})",
          R"({"op":"subscribe","subscriptions":[{"id":1}]})",
          R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
          R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
          R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]})",
          R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":"1"}]})",
          R"({"op":"unsubscribe","subscriptionIds":1})",
          R"({"op":"unsubscribe","subscriptionIds":["1"]})", "{\"op\":\"\xFF\"}"}) {
        const auto request = parse_request(text);
        EXPECT_TRUE(request.wrong.starts_with("expected ")) << text;
        EXPECT_TRUE(request.subscribe.empty() && request.unsubscribe.empty()) << text;
    }
    EXPECT_NE(parse_request(std::string(65536, '[')).wrong, "");
    std::string deep = R"({"op":"x","a":)";
    for (int i = 0; i < 16000; ++i) deep += "[";
    for (int i = 0; i < 16000; ++i) deep += "]";
    EXPECT_EQ(parse_request(deep + "}").unsupported, "x");
}

}  // namespace foxglove_protocol_test
}  // namespace dynamic_filter::live
