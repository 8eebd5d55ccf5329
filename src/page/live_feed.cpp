// SPDX-License-Identifier: MIT
#include "page/live_feed.hpp"

#include <array>
#include <cstring>
#include <utility>

#include "base/little_endian.hpp"
#include "geometry/verdict_code.hpp"
#include "page/sampling.hpp"

namespace dynamic_filter::app {

namespace {

constexpr std::size_t kMostKept = std::size_t{64} << 20U, kMostAtOnce = std::size_t{1} << 20U;
constexpr double kPointsOfScan = 5000.0;                        // of a scan
constexpr unsigned kNoTruth = 3U << 2U, kNoInstant = 3U << 4U;  // viewer/README.md
enum Kind : std::uint32_t { scan = 1, correction = 2 };

std::vector<std::uint32_t> chosen_of(const Points& points, std::size_t index) {
    const double share = kPointsOfScan / static_cast<double>(points.size());
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_sampled(index, i, share) && is_measured(points[i])) {
            chosen.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return chosen;
}

std::uint32_t number_of(const std::string& record) {
    std::uint32_t number = 0;
    std::memcpy(&number, record.data() + 4, sizeof number);
    return number;
}

}  // namespace

void LiveFeed::expect(const Points& points, const Pose& T_world_sensor, double stamp,
                      std::size_t index) {
    Expected expected;
    expected.chosen = chosen_of(points, index);
    expected.stamp = stamp;
    expected.T_world_sensor = T_world_sensor;
    for (const std::uint32_t i : expected.chosen) expected.points.push_back(points[i]);
    const std::lock_guard hold(lock_);
    expected_.insert_or_assign(index, std::move(expected));
}

void LiveFeed::judged(std::size_t index, const Labels& labels,
                      const std::optional<Tracked>& tracked) {
    std::array<std::uint32_t, 3> counts{};  // static, dynamic, unknown
    for (const Label label : labels) ++counts[(verdict_code(label) + 2U) % 3U];
    const std::lock_guard hold(lock_);
    const auto it = expected_.find(index);
    if (it == expected_.end()) return;
    const Expected& e = it->second;
    Pose T_view_sensor = tracked ? tracked->T_world_sensor : e.T_world_sensor;
    if (!origin_) origin_ = T_view_sensor.translation();
    T_view_sensor.translation() -= *origin_;
    const Eigen::Isometry3f T_near = T_view_sensor.cast<float>();
    std::string body;
    put(body, static_cast<std::uint32_t>(index));
    put(body, e.stamp);
    for (int axis = 0; axis < 3; ++axis) put(body, T_near.translation()[axis]);
    for (const std::uint32_t count : counts) put(body, count);
    put(body, static_cast<std::uint32_t>(e.chosen.size()));
    for (const Point& p : e.points) {
        const Point in_view = T_near * p;  // [m] from the first sensor
        for (int axis = 0; axis < 3; ++axis) put(body, in_view[axis]);
    }
    for (const std::uint32_t i : e.chosen) {
        const unsigned code = verdict_code(labels[i]);
        body += static_cast<char>(code | kNoTruth | code << 4U);
    }
    add(Kind::scan, std::move(body));
    expected_.erase(expected_.begin(), std::next(it));
}

void LiveFeed::corrected(std::size_t index, const Points& points, const Labels& labels) {
    const auto chosen = chosen_of(points, index);
    std::string body;
    put(body, static_cast<std::uint32_t>(index));
    put(body, static_cast<std::uint32_t>(chosen.size()));
    for (const std::uint32_t i : chosen) {
        body += static_cast<char>(verdict_code(labels[i]) | kNoTruth | kNoInstant);
    }
    const std::lock_guard hold(lock_);
    add(Kind::correction, std::move(body));
}

void LiveFeed::add(std::uint32_t kind, std::string body) {
    constexpr std::size_t kHead = 12;
    while (body.size() % 4 != 0) body += '\0';
    std::string record;
    record.reserve(kHead + body.size());
    put(record, static_cast<std::uint32_t>(kHead + body.size()));
    put(record, ++newest_);
    put(record, kind);
    record += body;
    bytes_ += record.size();
    records_.push_back(std::move(record));
    while (bytes_ > kMostKept) {
        bytes_ -= records_.front().size();
        records_.pop_front();
    }
}

std::string LiveFeed::after(std::uint32_t number) const {
    const std::lock_guard hold(lock_);
    std::string answer;
    if (records_.empty() || number >= newest_) return answer;
    const std::uint32_t oldest = number_of(records_.front());
    for (std::size_t i = number < oldest ? 0 : number - oldest + 1; i < records_.size(); ++i) {
        if (!answer.empty() && answer.size() + records_[i].size() > kMostAtOnce) break;
        answer += records_[i];
    }
    return answer;
}

std::uint32_t LiveFeed::newest() const {
    const std::lock_guard hold(lock_);
    return newest_;
}

}  // namespace dynamic_filter::app
