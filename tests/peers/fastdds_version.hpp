// SPDX-License-Identifier: MIT
/// Names that differ between Fast DDS 2 (Debian 12) and 3 (Debian 13).
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#if __has_include(<fastdds/rtps/common/SerializedPayload.hpp>)
#define DYNAMIC_FILTER_FASTDDS_3
#include <fastdds/dds/core/ReturnCode.hpp>
#include <fastdds/dds/core/Time_t.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/test_UDPv4TransportDescriptor.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/test_UDPv4TransportDescriptor.h>
#endif

namespace dynamic_filter::peers {

#ifdef DYNAMIC_FILTER_FASTDDS_3
using Payload = eprosima::fastdds::rtps::SerializedPayload_t;
using InstanceHandle = eprosima::fastdds::rtps::InstanceHandle_t;
using Duration = eprosima::fastdds::dds::Duration_t;
inline const auto kTaken = eprosima::fastdds::dds::RETCODE_OK;
inline bool is_sent(eprosima::fastdds::dds::ReturnCode_t returned) { return returned == kTaken; }
constexpr auto kGrowing =
    eprosima::fastdds::rtps::MemoryManagementPolicy_t::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
#else
using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
using InstanceHandle = eprosima::fastrtps::rtps::InstanceHandle_t;
using Duration = eprosima::fastrtps::Duration_t;
constexpr auto kTaken = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
inline bool is_sent(bool returned) { return returned; }
constexpr auto kGrowing = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
#endif

}  // namespace dynamic_filter::peers
