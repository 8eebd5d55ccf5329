// SPDX-License-Identifier: MIT
/// Times in the names of scans.
#pragma once

#include <optional>
#include <vector>

#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// Stamps [s] of scans whose names end in a time: SECONDS.FRACTION, SECONDS_NANOSECONDS, or a whole
/// number of seconds, milliseconds, microseconds or nanoseconds, which its size and the steps from
/// scan to scan tell. `unit` [s]: that of the numbers, if it is given. Empty if the names are no
/// times, for instance indices.
std::vector<double> times_in_names(const Paths& scans, std::optional<double> unit = {});

/// The same; empty also if the times do not increase.
std::vector<double> growing_times_in_names(const Paths& scans, std::optional<double> unit = {});

}  // namespace dynamic_filter::io
