// SPDX-License-Identifier: MIT
#pragma once

#include <ros/service_callback_helper.h>

#include <utility>

#include "live/bus.hpp"

namespace dynamic_filter::live {

/// Answers calls of a service whose messages roscpp does not know.
class RawService final : public ros::ServiceCallbackHelper {
public:
    explicit RawService(Serve serve) : serve_(std::move(serve)) {}
    /// False for a request that is none of its type.
    bool call(ros::ServiceCallbackHelperCallParams& params) override;

private:
    Serve serve_;
};

}  // namespace dynamic_filter::live
