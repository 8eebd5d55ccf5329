// SPDX-License-Identifier: MIT
/// Clouds of different sensors with the same fields, so that one map can hold the points of all.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::io {

struct CommonFields {
    std::vector<Field> fields{};  ///< of the clouds that are made
    bool with_times = false;      ///< `t` [s] relative to the stamp of the scan is one of them
    bool with_sensor = true;      ///< `sensor` is one of them, the number of the sensor
    std::string left_out{};  ///< names of fields that some clouds lack, with commas between them
};

/// x y z as float32, what all clouds have with the same type, `t` if `timed`, in place of the
/// fields from which times are read, and `sensor`, unless all clouds have such a field already.
CommonFields common_fields(const std::vector<Cloud>& clouds, bool timed);

/// The chosen points of the cloud, moved by `T`, in the unit of the cloud. Those at the origin are
/// no measurements, and stay there.
Cloud in_common_fields(const Cloud& cloud, const std::vector<std::size_t>& points,
                       const CommonFields& fields, const Pose& T, double stamp, std::size_t sensor);

}  // namespace dynamic_filter::io
