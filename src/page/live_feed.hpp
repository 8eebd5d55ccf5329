// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// Records for the live view (viewer/README.md), a few thousand points of each scan; old ones are
/// forgotten beyond 64 MB. Never waits for a client. Thread-safe.
class LiveFeed {
public:
    /// A scan that is about to be judged.
    void expect(const Points& points, const Pose& T_world_sensor, double stamp, std::size_t index);
    /// Its instant verdict, and its pose if that was not known before. Scans expected before it and
    /// not judged are forgotten.
    void judged(std::size_t index, const Labels& labels,
                const std::optional<Tracked>& tracked = {});
    /// Its final verdict; the same points and index as before.
    void corrected(std::size_t index, const Points& points, const Labels& labels);

    /// Records after a number, oldest first, at most about 1 MB of them.
    [[nodiscard]] std::string after(std::uint32_t number) const;
    [[nodiscard]] std::uint32_t newest() const;

private:
    struct Expected {
        std::vector<std::uint32_t> chosen;  ///< places among the scan's points
        Points points;                      ///< of those places, sensor frame
        Pose T_world_sensor = Pose::Identity();
        double stamp = 0.0;
    };
    void add(std::uint32_t kind, std::string body);

    mutable std::mutex lock_;
    std::optional<Eigen::Vector3d> origin_;
    std::map<std::size_t, Expected> expected_;  // by index
    std::deque<std::string> records_;
    std::size_t bytes_ = 0;
    std::uint32_t newest_ = 0;
};

}  // namespace dynamic_filter::app
