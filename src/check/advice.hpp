// SPDX-License-Identifier: MIT
/// What to type next, after a finding of the preflight check.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/check.hpp"
#include "recording/data_options.hpp"

namespace dynamic_filter::app {

/// A correction that was given although the poses were right is found as the opposite mistake.
/// Returns a finding that says so; other findings are returned as they are.
io::Finding blame_needless_fix(io::Finding finding, const DataOptions& given);

/// What `run` says about a finding before it begins.
std::string warning_of(const io::Finding& finding, const DataOptions& given);

/// The command that follows: `dynamicfilter run` with the recording, the options that were given to
/// read it, and `option`, which replaces a given one of the same name.
std::string next_command(const DataOptions& given, const std::string& option);

/// The same with several recordings, all of which are read with the given options.
std::string next_command(const std::vector<std::filesystem::path>& recordings,
                         const DataOptions& given, const std::string& option);

/// The options with one more, as it is typed: "--pose-fix cm". Empty if it is none of reading.
std::optional<DataOptions> with_option(DataOptions given, const std::string& option);

}  // namespace dynamic_filter::app
