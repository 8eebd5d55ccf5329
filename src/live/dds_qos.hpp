// SPDX-License-Identifier: MIT
/// Qualities of service in the words of Cyclone DDS.
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>

#include "live/bus.hpp"

namespace dynamic_filter::live {

struct DeleteQos {
    void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;

/// Writers send version 1 of CDR, as ROS 2 does.
Qos qos_of_writer(const Quality& quality);
/// Whoever sends version 2 of CDR is received, too.
Qos qos_of_reader(const Quality& quality);
/// The least that a publisher offers; what it does not say is DDS's default.
Quality quality_of(const dds_qos_t* qos);

/// Throws Error with the reasons of Cyclone DDS if `code` is that of a failure.
void require(dds_return_t code, const std::string& what);

}  // namespace dynamic_filter::live
