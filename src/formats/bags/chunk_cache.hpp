// SPDX-License-Identifier: MIT
/// A cache of the chunks that were read last, because messages are read roughly in the order in
/// which they are stored.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace dynamic_filter::io {

using Chunk = std::shared_ptr<const std::vector<std::byte>>;

/// Thread-safe. Two threads may read the same chunk at the same time; they do not wait for each
/// other.
class ChunkCache {
public:
    Chunk at(std::uint64_t offset, const std::function<std::vector<std::byte>()>& read) const {
        {
            const std::lock_guard lock(mutex_);
            const auto found = std::find_if(chunks_.begin(), chunks_.end(),
                                            [&](const auto& c) { return c.first == offset; });
            if (found != chunks_.end()) return found->second;
        }
        const Chunk chunk = std::make_shared<const std::vector<std::byte>>(read());
        const std::lock_guard lock(mutex_);
        if (chunks_.size() == kMost) chunks_.erase(chunks_.begin());
        chunks_.emplace_back(offset, chunk);
        return chunk;
    }

private:
    static constexpr std::size_t kMost = 4;
    mutable std::mutex mutex_;
    mutable std::vector<std::pair<std::uint64_t, Chunk>> chunks_;  // oldest first
};

}  // namespace dynamic_filter::io
