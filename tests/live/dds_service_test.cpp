// SPDX-License-Identifier: MIT
#include "live/dds_service.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "dynamic_filter/error.hpp"
#include "live/dds_bus.hpp"
#include "live/dds_support.hpp"

namespace dynamic_filter::live {
namespace dds_service_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Patience kLong{.for_service = seconds(30), .for_answer = seconds(30)};
constexpr Patience kShort{.for_service = milliseconds(100), .for_answer = milliseconds(300)};

struct DdsServices : testing::Test {
    ReservedDomain domain;
    DdsBus filter{{.domain = domain.number(), .network = "localhost"}};
    DdsBus other{{.domain = domain.number(), .network = "localhost"}};

    ServiceAnswer ask(bool value) {
        const Bytes message = other.call(
            "/filter/pause", kSetBool,
            [&](io::MessageWriter& out) { out.number(std::uint8_t{value}); }, kLong);
        io::MessageReader in = read_dds_answer(message);
        return read_answer(in);
    }
};

TEST_F(DdsServices, AnswerWhatWasAsked) {
    filter.serve("/filter/pause", kSetBool, [](io::MessageReader& in, io::MessageWriter& out) {
        const bool value = in.number<std::uint8_t>() != 0;
        write(out, {.success = value, .message = value ? "on" : "off"});
    });
    for (const bool value : {true, false, true}) {
        const ServiceAnswer answer = ask(value);
        EXPECT_EQ(answer.success, value);
        EXPECT_EQ(answer.message, value ? "on" : "off");
    }
}

TEST_F(DdsServices, EachClientGetsTheAnswerToItsOwnRequest) {
    filter.serve("/filter/save_map_as", kSaveMap,
                 [](io::MessageReader& in, io::MessageWriter& out) {
                     write(out, {.success = true, .message = in.text()});
                 });
    const auto client = [&](const std::string& name) {
        DdsBus bus({.domain = domain.number(), .network = "localhost"});
        for (int i = 0; i < 20; ++i) {
            const std::string text = name + std::to_string(i);
            const Bytes message = bus.call(
                "/filter/save_map_as", kSaveMap, [&](io::MessageWriter& out) { out.text(text); },
                kLong);
            io::MessageReader in = read_dds_answer(message);
            if (read_answer(in).message != text) return false;
        }
        return true;
    };
    auto first = std::async(std::launch::async, client, "a"),
         second = std::async(std::launch::async, client, "b");
    EXPECT_TRUE(first.get());
    EXPECT_TRUE(second.get());
}

TEST_F(DdsServices, ARequestThatIsTooShortGetsNoAnswer) {
    std::atomic<int> calls = 0;
    filter.serve("/filter/pause", kSetBool, [&](io::MessageReader& in, io::MessageWriter& out) {
        if (in.text().empty()) ++calls;
        write(out, {});
    });
    EXPECT_TRUE(eventually([&] {
        try {
            other.call(
                "/filter/pause", kSetBool, [](io::MessageWriter&) {}, kShort);
        } catch (const Error& error) {
            return std::string(error.what()).ends_with("does not answer");
        }
        return false;
    }));
    EXPECT_EQ(calls, 0);
}

TEST_F(DdsServices, NobodyOffersTheService) {
    try {
        other.call(
            "/nothing/save_map", kTrigger, [](io::MessageWriter&) {}, kShort);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "nobody offers the service /nothing/save_map; is the filter running?");
    }
}

TEST_F(DdsServices, NothingIsAnsweredOnceTheBusHasStopped) {
    filter.serve("/filter/pause", kSetBool, [](io::MessageReader&, io::MessageWriter& out) {
        write(out, {.success = true, .message = ""});
    });
    EXPECT_TRUE(ask(true).success);
    filter.stop();
    EXPECT_THROW(other.call(
                     "/filter/pause", kSetBool, [](io::MessageWriter&) {}, kShort),
                 Error);
}

}  // namespace dds_service_test
}  // namespace dynamic_filter::live
