// SPDX-License-Identifier: MIT
/// Scans that a driver wrote again, when no new one came from the sensor.
#pragma once

#include <cstdint>
#include <vector>

#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// By file: 1 if it holds the same bytes as the file before it, else 0. Empty if no file does, or
/// if more than half do: those are no mistakes, but scans of a simulator without noise. Files of up
/// to 4 kB, and those that cannot be read, are no repeats.
std::vector<std::uint8_t> repeats_among(const Paths& files);

}  // namespace dynamic_filter::io
