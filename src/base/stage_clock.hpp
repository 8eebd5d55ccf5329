// SPDX-License-Identifier: MIT
/// Measures the time of each stage of the process, from the start of the process.
#pragma once

#include <string>
#include <vector>

namespace dynamic_filter::app {

/// [s]
struct Seconds {
    double wall = 0.0;  ///< by the clock on the wall
    double cpu = 0.0;   ///< of all threads, in the program and in the kernel for it
};

/// Cuts the time since the process began into stages that follow each other without gaps. Single
/// caller.
class StageClock {
public:
    struct Stage {
        std::string name;
        Seconds seconds;
    };

    /// Ends the stage that began where the one before it ended; the first began with the process.
    void finish(std::string name);
    [[nodiscard]] const std::vector<Stage>& stages() const { return stages_; }
    [[nodiscard]] Seconds total() const { return last_; }  ///< until the last stage ended

private:
    std::vector<Stage> stages_;
    Seconds last_;
};

}  // namespace dynamic_filter::app
