// SPDX-License-Identifier: MIT
/// scan_by_scan: scans as they come, a verdict on each at once, and a better one at the end. The
/// scans are made up here: a room, and a box that passes through it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <dynamic_filter/dynamic_filter.hpp>

namespace df = dynamic_filter;

namespace {

/// Where a beam ends: at the box, or at the walls 10 m away.
float range(float azimuth, float box_azimuth) {
    const bool at_box = std::abs(azimuth - box_azimuth) < 0.1F;
    return at_box ? 4.0F
                  : 10.0F / std::max(std::abs(std::cos(azimuth)), std::abs(std::sin(azimuth)));
}

df::Scan measure(std::size_t index) {
    df::Scan scan;
    scan.index = index;
    scan.stamp = 0.1 * static_cast<double>(index);  // [s]
    scan.T_world_sensor = df::Pose::Identity();     // from your SLAM
    const float box_azimuth = -1.5F + 0.05F * static_cast<float>(index);
    for (float elevation = -0.2F; elevation < 0.2F; elevation += 0.03F) {
        for (float azimuth = -3.14F; azimuth < 3.14F; azimuth += 0.01F) {
            const df::Point direction(std::cos(azimuth), std::sin(azimuth), std::tan(elevation));
            scan.points.push_back(range(azimuth, box_azimuth) * direction);  // sensor frame [m]
        }
    }
    return scan;
}

auto count(const df::Labels& labels, df::Label label) {
    return std::count(labels.begin(), labels.end(), label);
}

}  // namespace

int main() {
    df::DynamicFilter filter{df::Config{}};
    for (std::size_t i = 0; i < 60; ++i) {
        const df::Verdict verdict = filter.push(measure(i));
        if (i % 10 != 0) continue;
        std::printf("scan %zu: %td points move\n", i, count(verdict.labels, df::Label::dynamic));
    }
    filter.finish();
    const auto moving = count(filter.verdict(measure(30)).labels, df::Label::dynamic);
    std::printf("scan 30, in the end: %td points move\n", moving);
    return moving > 0 ? 0 : 1;
}
