// SPDX-License-Identifier: MIT
/// A DDS type of which only the name is known here: samples are the bytes of their CDR encoding,
/// as io::MessageReader reads them and io::MessageWriter makes them. ROS 2 does the same.
#pragma once

#include <dds/dds.h>

#include <optional>
#include <string>

#include "live/bus.hpp"

namespace dynamic_filter::live {

/// [bytes] The largest message that is received; larger ones are dropped.
constexpr std::size_t kLargestMessage = std::size_t{256} << 20;

/// Creates a topic whose type has no key. Returns an error code below 0 if Cyclone DDS refuses.
dds_entity_t create_topic_of_bytes(dds_entity_t participant, const std::string& name,
                                   const std::string& type);

/// Takes the oldest message of a reader; empty if there is none. What is no message (the end of a
/// publisher) is skipped.
std::optional<Bytes> pop_bytes(dds_entity_t reader);

/// Sends a message. Never waits; returns a code below 0 if the message was not taken.
dds_return_t write_bytes(dds_entity_t writer, const Bytes& message);

}  // namespace dynamic_filter::live
