// SPDX-License-Identifier: MIT
/// Memory that runs out on demand: replaces operator new of the executable that it is linked into.
#pragma once

namespace dynamic_filter::fuzz {

/// As long as it lives, the k-th allocation from now, counted over all threads, throws, and so do
/// `more` behind it.
class NoMemory {
public:
    NoMemory(long k, long more);
    NoMemory(const NoMemory&) = delete;
    NoMemory& operator=(const NoMemory&) = delete;
    ~NoMemory();
    /// Whether that many were asked for.
    [[nodiscard]] bool was_met() const;
};

}  // namespace dynamic_filter::fuzz
