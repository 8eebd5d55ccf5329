// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dynamic_filter::io {

/// Text of one byte a character, of text in UTF-16 that begins with its byte order mark, as some
/// programs of Windows write it. Characters beyond ASCII become '?'. Other text stays as it is.
std::string decoded(std::string text);

}  // namespace dynamic_filter::io
