// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::io {

/// The record of scan i alone. Throws InputError.
Cloud read_scan(const Sequence& sequence, std::size_t i);

}  // namespace dynamic_filter::io
