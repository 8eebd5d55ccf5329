// SPDX-License-Identifier: MIT
#include "online/scan_queue.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "tracking/pose_jump.hpp"

namespace dynamic_filter {

namespace {

std::string seconds(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6f s", value);
    return text;
}

bool is_rigid(const Pose& pose) {
    constexpr double kTolerance = 1e-3;
    const Eigen::Matrix3d r = pose.linear();
    return pose.matrix().allFinite() && r.determinant() > 0.0 &&
           (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kTolerance;
}

bool is_same(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }

}  // namespace

bool ScanQueue::restarts(double stamp) const { return newest_ && stamp < *newest_ - kRestart; }

std::optional<Notice> ScanQueue::refusal(const Scan& scan) const {
    const auto because = [&](NoticeKind kind, const std::string& text) {
        return Notice{kind, scan.index, text};
    };
    if (!std::isfinite(scan.stamp)) {
        return because(NoticeKind::invalid, "its stamp is not a number");
    }
    if (with_poses_ && *with_poses_ != scan.has_pose) {
        return because(NoticeKind::invalid, scan.has_pose
                                                ? "it has a pose, but those before had none"
                                                : "it has no pose, but those before had one");
    }
    if (!scan.times.empty() && scan.times.size() != scan.points.size()) {
        return because(NoticeKind::invalid, "it has " + std::to_string(scan.times.size()) +
                                                " times, but " +
                                                std::to_string(scan.points.size()) + " points");
    }
    if (scan.has_pose && !is_rigid(scan.T_world_sensor)) {
        return because(NoticeKind::invalid,
                       "its pose is not a rigid motion; is the quaternion normalised?");
    }
    if (restarts(scan.stamp)) return std::nullopt;
    const auto repeats = [&](std::uint64_t stretch, double stamp, const Pose& pose) {
        return stretch == stretch_ && stamp == scan.stamp && is_same(pose, scan.T_world_sensor);
    };
    const bool waits = std::any_of(waiting_.begin(), waiting_.end(), [&](const QueuedScan& w) {
        return repeats(w.stretch, w.scan.stamp, w.scan.T_world_sensor);
    });
    const auto found = taken_.find(scan.sensor);
    const Taken* const taken = found == taken_.end() ? nullptr : &found->second;
    if (waits || (taken && repeats(taken->stretch, taken->stamp, taken->T_world_sensor))) {
        return because(NoticeKind::duplicate,
                       "the scan of " + seconds(scan.stamp) + " at this pose was pushed before");
    }
    if (taken && taken->stretch == stretch_ && scan.stamp < taken->stamp) {
        return because(NoticeKind::late, "its stamp " + seconds(scan.stamp) +
                                             " is before that of a scan already judged, " +
                                             seconds(taken->stamp));
    }
    return std::nullopt;
}

void ScanQueue::add(QueuedScan waiting) {
    const double stamp = waiting.scan.stamp;
    with_poses_ = waiting.scan.has_pose;
    waiting.was_wanted = std::exchange(begins_anew_, false);
    if (waiting.was_wanted || restarts(stamp)) {
        ++stretch_;
        newest_.reset();
    }
    newest_ = std::max(stamp, newest_.value_or(stamp));
    waiting.stretch = stretch_;
    const auto before = [](const QueuedScan& a, const QueuedScan& b) {
        return std::pair(a.stretch, a.scan.stamp) < std::pair(b.stretch, b.scan.stamp);
    };
    const auto place = std::upper_bound(waiting_.begin(), waiting_.end(), waiting, before);
    waiting_.insert(place, std::move(waiting));
}

QueuedScan ScanQueue::remove_oldest() {
    QueuedScan oldest = std::move(waiting_.front());
    waiting_.pop_front();
    return oldest;
}

QueuedScan ScanQueue::pop() {
    QueuedScan oldest = remove_oldest();
    taken_[oldest.scan.sensor] = {oldest.stretch, oldest.scan.stamp, oldest.scan.T_world_sensor};
    return oldest;
}

QueuedScan ScanQueue::drop() { return remove_oldest(); }

std::variant<QueuedScan, Notice> ScanQueue::pass(Scan scan) {
    if (auto refused = refusal(scan)) return std::move(*refused);
    add({.scan = std::move(scan), .reply = nullptr});
    return pop();
}

}  // namespace dynamic_filter
