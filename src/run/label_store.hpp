// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// Labels of scans until they are asked for again: on disk, in a file without a name, two bits a
/// point, because those of a long recording need more memory than its map. Nothing is left of it
/// when the process ends, however it ends. Thread-safe. Throws OutputError with the system's
/// reason.
class LabelStore {
public:
    /// The file lies on the disk of `folder`; it is made when the first labels come.
    explicit LabelStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
    LabelStore(const LabelStore&) = delete;
    LabelStore& operator=(const LabelStore&) = delete;
    ~LabelStore();

    void put(std::size_t scan, const Labels& labels);  ///< once for each scan
    /// Empty if none were put.
    [[nodiscard]] Labels get(std::size_t scan) const;

private:
    struct Place {
        std::uint64_t offset = 0;  // bytes
        std::size_t count = 0;     // labels
    };
    [[nodiscard]] Place place_of(std::size_t scan) const;

    std::filesystem::path folder_;
    mutable std::mutex lock_{};
    std::map<std::size_t, Place> places_{};  // by scan
    std::uint64_t end_ = 0;                  // bytes
    int descriptor_ = -1;
};

}  // namespace dynamic_filter::app
