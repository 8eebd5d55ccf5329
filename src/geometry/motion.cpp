// SPDX-License-Identifier: MIT
#include "dynamic_filter/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace dynamic_filter {
namespace {

// [rad] below this angle, a short series is more precise than the formula.
constexpr double kTiny = 1e-4;

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return m;
}

/// Left Jacobian of SO(3): the effect of the rotation on the translation during the motion.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& rotation) {
    const double angle = rotation.norm();
    const Eigen::Matrix3d w = cross(rotation);
    if (angle < kTiny) return Eigen::Matrix3d::Identity() + 0.5 * w + w * w / 6.0;
    const double a2 = angle * angle;
    return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / a2 * w +
           (angle - std::sin(angle)) / (a2 * angle) * w * w;
}

/// Poses of the sensor at moments of a scan, relative to that at its stamp. Each one is computed
/// once.
class PosesInScan {
public:
    explicit PosesInScan(const Twist& velocity) : velocity_(velocity) {}
    const Eigen::Isometry3f& at(float time) {
        constexpr float kStep = 1e-4F;      // [s] points within this time share a pose
        constexpr float kMostSteps = 1e9F;  // fits into an integer
        const float step = std::isfinite(time)
                               ? std::clamp(std::round(time / kStep), -kMostSteps, kMostSteps)
                               : 0.0F;
        // Steps that are far apart may share a place, and are then computed again.
        Entry& entry =
            entries_[static_cast<std::uint32_t>(static_cast<std::int64_t>(step)) % entries_.size()];
        if (entry.step != step) {
            const auto seconds = static_cast<double>(step * kStep);
            entry = {step, exp(seconds * velocity_).cast<float>()};
        }
        return entry.T_stamp_then;
    }

private:
    struct Entry {
        float step = std::numeric_limits<float>::quiet_NaN();
        Eigen::Isometry3f T_stamp_then = Eigen::Isometry3f::Identity();
    };
    Twist velocity_;
    std::vector<Entry> entries_ = std::vector<Entry>(2048);
};

}  // namespace

Pose exp(const Twist& twist) {
    const Eigen::Vector3d rotation = twist.tail<3>();
    const double angle = rotation.norm();
    Pose pose = Pose::Identity();
    if (angle > 0.0) pose.linear() = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
    pose.translation() = left_jacobian(rotation) * twist.head<3>();
    return pose;
}

Twist log(const Pose& displacement) {
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(displacement.linear()).normalized());
    Twist twist;
    twist.tail<3>() = turn.angle() * turn.axis();
    twist.head<3>() =
        left_jacobian(twist.tail<3>()).partialPivLu().solve(displacement.translation());
    return twist;
}

Points moved(const Points& points, const Pose& T_to_from) {
    const Eigen::Isometry3f transform = T_to_from.cast<float>();
    Points out(points.size());
    std::transform(points.begin(), points.end(), out.begin(),
                   [&](const Point& p) { return transform * p; });
    return out;
}

Points undo_motion(const Points& points, std::span<const float> times, const Twist& velocity) {
    Points undone(points.size());
    PosesInScan poses(velocity);
    for (std::size_t i = 0; i < points.size(); ++i) {
        undone[i] = is_measured(points[i]) ? poses.at(times[i]) * points[i] : points[i];
    }
    return undone;
}

}  // namespace dynamic_filter
