// SPDX-License-Identifier: MIT
#pragma once

#include <ros/service_callback_helper.h>

#include <string>

#include "live/bus.hpp"

namespace dynamic_filter::live {

/// The type of a service of std_srvs, as roscpp wants it.
struct ServiceType {
    std::string name, md5;
};
ServiceType type_of(ServiceKind kind);

/// Answers calls of a service of std_srvs.
class RawService final : public ros::ServiceCallbackHelper {
public:
    RawService(ServiceKind kind, Bus::Serve serve) : kind_(kind), serve_(std::move(serve)) {}
    /// False for a request of another length.
    bool call(ros::ServiceCallbackHelperCallParams& params) override;

private:
    ServiceKind kind_;
    Bus::Serve serve_;
};

}  // namespace dynamic_filter::live
