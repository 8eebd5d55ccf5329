// SPDX-License-Identifier: MIT
#include "live/foxglove_queue.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::live {
namespace foxglove_queue_test {

Outgoing message(std::uint32_t subscription, std::size_t size, const std::string& name = "") {
    return {name, std::make_shared<const std::vector<std::byte>>(size), subscription};
}

/// The heads of all that waits, in the order in which they are sent.
std::string all(FoxgloveQueue& queue) {
    std::string heads;
    while (const auto next = queue.pop()) heads += next->head;
    EXPECT_TRUE(queue.empty());
    return heads;
}

TEST(FoxgloveQueue, TextsComeBeforeMessages) {
    FoxgloveQueue queue(100);
    queue.put_message(message(1, 10, "a"), 5);
    queue.put_text("b");
    queue.put_text("c");
    queue.put_message(message(2, 10, "d"), 5);
    EXPECT_EQ(queue.texts(), 2U);
    EXPECT_EQ(all(queue), "bcad");
}

TEST(FoxgloveQueue, TheOldestOfATopicIsDropped) {
    FoxgloveQueue queue(1000);
    for (const char* name : {"a", "b", "c", "d"}) queue.put_message(message(1, 10, name), 2);
    queue.put_message(message(2, 10, "x"), 0);
    queue.put_message(message(2, 10, "y"), 0);
    EXPECT_EQ(all(queue), "cdy");
}

TEST(FoxgloveQueue, BytesAreLimited) {
    FoxgloveQueue queue(100);
    EXPECT_TRUE(queue.put_message(message(1, 50, "a"), 9));
    EXPECT_TRUE(queue.put_message(message(2, 50, "b"), 9));
    EXPECT_FALSE(queue.put_message(message(3, 1, "c"), 9)) << "others' messages fill the queue";
    EXPECT_TRUE(queue.put_message(message(1, 50, "d"), 9));
    EXPECT_FALSE(queue.put_message(message(1, 51, "e"), 9));
    EXPECT_TRUE(queue.put_message(message(1, 1, "f"), 9));
    EXPECT_EQ(all(queue), "bf");
    EXPECT_TRUE(queue.put_message(message(1, 100, "g"), 9)) << "what was taken has left room";
}

TEST(FoxgloveQueue, ALargeMessageIsTakenAlone) {
    FoxgloveQueue queue(100);
    EXPECT_TRUE(queue.put_message(message(1, 500, "a"), 9));
    EXPECT_FALSE(queue.put_message(message(2, 1, "b"), 9));
    EXPECT_TRUE(queue.put_message(message(1, 600, "c"), 9));
    EXPECT_EQ(all(queue), "c");
}

TEST(FoxgloveQueue, WhatIsNotWantedIsForgotten) {
    FoxgloveQueue queue(100);
    queue.put_message(message(1, 40, "a"), 9);
    queue.put_message(message(2, 40, "b"), 9);
    queue.forget(1);
    EXPECT_TRUE(queue.put_message(message(3, 60, "c"), 9));
    EXPECT_EQ(all(queue), "bc");
    queue.put_text("d");
    queue.clear();
    EXPECT_EQ(all(queue), "");
}

}  // namespace foxglove_queue_test
}  // namespace dynamic_filter::live
