// SPDX-License-Identifier: MIT
#include "live/dds_log.hpp"

#include <dds/ddsrt/log.h>

#include <algorithm>
#include <mutex>
#include <string_view>
#include <utility>

namespace dynamic_filter::live {

namespace {

struct Log {
    std::mutex lock;
    std::vector<std::string> lines;
};

Log& kept() {
    static Log log;
    return log;
}

void keep(void*, const dds_log_data_t* data) {
    // Mere information is that loopback is taken as capable of multicast, at each start.
    if ((data->priority & (DDS_LC_FATAL | DDS_LC_ERROR | DDS_LC_WARNING)) == 0) return;
    constexpr std::size_t kMost = 8, kLongest = 160, kAlike = 30;
    std::string_view line = std::string_view(data->message).substr(0, kLongest);
    while (line.ends_with('\n')) line.remove_suffix(1);
    Log& log = kept();
    const std::lock_guard hold(log.lock);
    if (log.lines.size() < kMost &&
        std::none_of(log.lines.begin(), log.lines.end(), [&](const std::string& other) {
            return other.substr(0, kAlike) == line.substr(0, kAlike);
        })) {
        log.lines.emplace_back(line);
    }
}

}  // namespace

void keep_dds_log() {
    kept();  // outlives whatever is kept
    dds_set_log_sink(keep, nullptr);
}

std::vector<std::string> pop_dds_log() {
    Log& log = kept();
    const std::lock_guard hold(log.lock);
    return std::exchange(log.lines, {});
}

}  // namespace dynamic_filter::live
