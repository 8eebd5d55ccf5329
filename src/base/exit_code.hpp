// SPDX-License-Identifier: MIT
#pragma once

namespace dynamic_filter::app {

/// Exit codes of the programs.
enum ExitCode {
    kDone = 0,
    kInternal = 1,
    kUsage = 2,
    kInput = 3,
    kRejected = 4,
    kInterrupted = 130
};

}  // namespace dynamic_filter::app
