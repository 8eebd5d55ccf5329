// SPDX-License-Identifier: MIT
/// The recording that goes with a result.
#pragma once

#include <filesystem>
#include <string>

#include "dynamic_filter/recording.hpp"
#include "recording/data_options.hpp"

namespace dynamic_filter::app {

struct RecordingOfResult {
    io::Recording recording;
    std::string note{};  ///< how it differs from open(), a sentence for the user; may be empty
};

/// Opens a recording for a command that takes a result of a run with it. `result`: the output
/// folder, its labels, or a file in it.
///
/// The recording of the run is read as the run read it, with the poses and the points of the run;
/// options that are given go before, above all `poses`. Of its scans, those that `asked` selects
/// are left. Another recording, such as one with exact poses, is opened as asked; only if it has no
/// poses it gets those of the result. Throws an Error, also if the result's poses are of another
/// number of scans.
RecordingOfResult open_for_result(const DataOptions& asked, const std::filesystem::path& result);

}  // namespace dynamic_filter::app
