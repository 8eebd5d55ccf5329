// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "peers/fastdds_type.hpp"

namespace dynamic_filter::peers {

/// The fields of a message as Fast CDR reads them, in their order, separated by spaces; numbers
/// with all digits, texts in quotes. `type` is a name of ROS 2 on the wire. Ends with "left" and
/// the number of bytes behind the last field. Throws std::exception on what does not fit the type.
std::string text_of(const std::string& type, Bytes message);

}  // namespace dynamic_filter::peers
