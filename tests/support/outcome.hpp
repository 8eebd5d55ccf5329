// SPDX-License-Identifier: MIT
/// Runs the whole pipeline over scans with known truth, and judges what comes out.
#pragma once

#include <gtest/gtest.h>

#include "online/maps.hpp"
#include "support/room.hpp"

namespace dynamic_filter::test {

/// Preset paper with windows of 4 s, because these recordings are short; all else as shipped.
inline Config small_windows() {
    Config config = preset("paper");
    config.submap.keyframes = 8;
    config.keyframe.interval = 0.5;
    config.keyframe.distance = 100.0;
    return config;
}

struct Outcome {
    std::vector<Verdict> instant, final;
    std::size_t submaps = 0;
};

/// The scan at the pose that its instant verdict tells, if it does.
inline Scan placed(Scan scan, const std::vector<Verdict>& instant) {
    for (const Verdict& v : instant) {
        if (v.index != scan.index || !v.tracked) continue;
        scan.T_world_sensor = v.tracked->T_world_sensor;
        scan.has_pose = true;
    }
    return scan;
}

inline Outcome run(const std::vector<RoomScan>& scans, const Config& config) {
    Maps maps(config, {.horizon = 0.0, .max_bytes = 0});
    Outcome result;
    const auto add = [&](Maps::Judged judged) {
        for (Verdict& v : judged.instant) result.instant.push_back(std::move(v));
    };
    for (const RoomScan& s : scans) {
        add(maps.judge(s.scan, Maps::Follows::on));
        maps.catch_up();
    }
    add(maps.finish());
    for (const RoomScan& s : scans) {
        result.final.push_back(maps.verdict(placed(s.scan, result.instant)));
    }
    result.submaps = maps.contents().observers;
    return result;
}

inline void expect_same(const std::vector<Verdict>& a, const std::vector<Verdict>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t s = 0; s < a.size(); ++s) {
        EXPECT_EQ(a[s].index, b[s].index);
        EXPECT_EQ(a[s].labels, b[s].labels) << s;
        EXPECT_EQ(a[s].probability, b[s].probability) << s;
    }
}

/// Share of the points of one truth that have the verdict.
inline double share(const std::vector<RoomScan>& scans, const std::vector<Verdict>& verdicts,
                    Label truth, Label verdict) {
    double all = 0.0, right = 0.0;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        for (std::size_t i = 0; i < scans[s].truth.size(); ++i) {
            if (scans[s].truth[i] != truth) continue;
            all += 1.0;
            right += verdicts[s].labels[i] == verdict ? 1.0 : 0.0;
        }
    }
    return right / all;
}

inline bool all_are(const std::vector<Verdict>& verdicts, Label label) {
    for (const Verdict& v : verdicts) {
        for (const Label l : v.labels) {
            if (l != label) return false;
        }
    }
    return true;
}

}  // namespace dynamic_filter::test
