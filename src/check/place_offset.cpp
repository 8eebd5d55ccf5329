// SPDX-License-Identifier: MIT
#include "check/place_offset.hpp"

#include <tsl/robin_map.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/numbers.hpp"
#include "dynamic_filter/error.hpp"
#include "geometry/voxel.hpp"
#include "tracking/coarse_search.hpp"
#include "tracking/registration.hpp"
#include "tracking/scan_sample.hpp"
#include "tracking/surface_map.hpp"

namespace dynamic_filter::io {
namespace {

constexpr SearchWindow kWindow{6.0, 6.0 * kRoundedDegree};
constexpr std::size_t kCandidates = 6;  // of the search seen from above
constexpr double kReach = 1.0;          // [m] initial reach of the registration
constexpr double kNearly = 0.95;        // share of the fit that counts as equally good
constexpr double kFits = 0.5;           // smallest share of points on surfaces that is believed
constexpr float kColumnSize = 0.6F;     // [m]
constexpr float kUprightHeight = 0.5F;  // [m] height of a column of points that counts as upright
constexpr std::size_t kMostUpright = 2500, kMostOther = 1000;  // points that are registered
constexpr std::size_t kFewestUpright = 100;                    // upright points
// Errors that the registration does not know of, such as noise of the poses around the place.
constexpr double kShiftFloor = 0.03, kYawFloor = 0.06 * kRoundedDegree;  // [m], [rad]

/// Lowest and highest point of each column.
class PointColumns {
public:
    PointColumns(const Points& points, float size) : per_metre_(1.0F / size) {
        for (const Point& p : points) {
            const auto column = key(p);
            if (!column) continue;
            Extent& e = extents_.try_emplace(*column, Extent{p.z(), p.z()}).first.value();
            e = {std::min(e.low, p.z()), std::max(e.high, p.z())};
        }
    }
    [[nodiscard]] bool is_upright(const Point& p) const {
        const auto column = key(p);
        const auto found = column ? extents_.find(*column) : extents_.end();
        return found != extents_.end() && found->second.high - found->second.low > kUprightHeight;
    }
    /// How much lower the columns of `other` begin, in the median of common columns near the place;
    /// 0 if there are few of them.
    [[nodiscard]] double depth_of(const PointColumns& other) const {
        constexpr float kNear = 25.0F;       // [m]
        constexpr std::size_t kEnough = 30;  // columns
        std::vector<float> depths;
        for (const auto& [column, extent] : extents_) {
            const auto found = other.extents_.find(column);
            const bool near = center(column, 1.0F / per_metre_).head<2>().norm() < kNear;
            if (near && found != other.extents_.end()) {
                depths.push_back(extent.low - found->second.low);
            }
        }
        if (depths.size() < kEnough) return 0.0;
        return static_cast<double>(median(std::move(depths)));
    }

private:
    struct Extent {
        float low, high;
    };
    [[nodiscard]] std::optional<VoxelKey> key(const Point& p) const {
        const auto cell = cell_of({p.x(), p.y(), 0.0F}, per_metre_);
        return cell ? std::optional(pack(*cell)) : std::nullopt;
    }
    float per_metre_;
    tsl::robin_map<VoxelKey, Extent, VoxelHash> extents_;
};

void thin(Points& points, std::size_t most) {
    if (points.size() <= most) return;
    for (std::size_t i = 0; i < most; ++i) points[i] = points[i * points.size() / most];
    points.resize(most);
}

/// Mainly upright structures: the ground fits everywhere, so it would hide what does not.
Points chosen_for_registration(const Points& cloud) {
    OdometryConfig config;
    config.nearest = 0.0;
    config.points = static_cast<int>(cloud.size());
    ScanSample whole{std::vector<std::uint32_t>(cloud.size()), cloud, {}};
    std::iota(whole.chosen.begin(), whole.chosen.end(), 0U);
    const ScanSample sample = sample_for_registration(whole, config);
    const PointColumns columns(cloud, kColumnSize);
    Points upright, other;
    for (const Point& p : sample.points) {
        (columns.is_upright(p) ? upright : other).push_back(p);
    }
    if (upright.size() < kFewestUpright) return {};
    thin(upright, kMostUpright);
    thin(other, kMostOther);
    upright.insert(upright.end(), other.begin(), other.end());
    return upright;
}

/// Keeps the result near the start in directions that the points do not show.
PosePrior weak_prior(const Pose& start, double tilt) {
    constexpr double kShift = 5.0, kTurn = 5.0 * kRoundedDegree;
    PosePrior prior{start, Information::Zero()};
    prior.information.diagonal() << Eigen::Vector3d::Constant(1.0 / (kShift * kShift)),
        Eigen::Vector2d::Constant(1.0 / (tilt * tilt)), 1.0 / (kTurn * kTurn);
    return prior;
}

Pose raised(double height) {
    Pose pose = Pose::Identity();
    pose.translation().z() = height;
    return pose;
}

/// Starts of the registration: as given, raised to the same ground, and what looks alike from
/// above.
std::vector<Pose> starts_of(const Points& a, const Points& b) {
    const double height = PointColumns(a, 1.0F).depth_of(PointColumns(b, 1.0F));
    std::vector<Pose> starts = {Pose::Identity(), raised(height)};
    for (const Pose& pose : search_displacements(a, b, kWindow, kCandidates)) {
        starts.push_back(raised(height) * pose);
    }
    return starts;
}

Registration best_registration(const SurfaceMap& map, const Points& points,
                               const std::vector<Pose>& starts, double tilt) {
    const auto shift_of = [](const Registration& r) { return r.T_map_sensor.translation().norm(); };
    Registration best;
    for (const Pose& start : starts) {
        const Registration found =
            register_points(map, points, start, weak_prior(start, tilt), kReach);
        // Of corrections that fit nearly equally well, the smaller one is right more often.
        const bool nearer = shift_of(found) < shift_of(best);
        if (nearer ? found.inliers > kNearly * best.inliers
                   : kNearly * found.inliers > best.inliers) {
            best = found;
        }
    }
    return best;
}

/// Covariance of a displacement that the points tell, with what the registration does not know of.
Information covariance_of(const Information& of_points) {
    Information regular = of_points;
    regular.diagonal().array() += 1e-6;
    Information covariance = regular.inverse();
    covariance.diagonal().head<3>().array() += kShiftFloor * kShiftFloor;
    covariance.diagonal().tail<3>().array() += kYawFloor * kYawFloor;
    return covariance;
}

/// Information about x, y, z and the turn, for any tilt.
FlatInformation flat_information(const Information& covariance) {
    constexpr std::array<Eigen::Index, 4> kKept = {0, 1, 2, 5};
    const FlatInformation flat = covariance(kKept, kKept);
    return flat.inverse();
}

}  // namespace

bool PlaceOffset::fits() const { return fit >= kFits; }

Information in_sensor(const Information& of_world, const Pose& T_world_sensor) {
    Information turn = Information::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_world_sensor.linear();
    return turn.transpose() * of_world * turn;
}

Points cloud_around(const Recording& recording, const std::vector<std::size_t>& scans,
                    const Eigen::Vector3d& place) {
    const OdometryConfig config;
    Points cloud;
    for (const std::size_t i : scans) {
        try {
            const FullScan scan = recording.read(i);
            if (!scan.has_pose) continue;
            const Pose T_place_sensor = Eigen::Translation3d(-place) * scan.T_world_sensor;
            const ScanSample sample = sample_for_map(scan.points, {}, config);
            const Points here = moved(sample.points, T_place_sensor);
            cloud.insert(cloud.end(), here.begin(), here.end());
        } catch (const InputError&) {
            continue;  // the neighbours of the scan will do
        }
    }
    return cloud;
}

std::optional<PlaceOffset> register_clouds(const Points& a, const Points& b,
                                           const Eigen::Vector3d& place, double tilt) {
    const Points points = chosen_for_registration(b);
    if (points.empty() || a.size() < kFewestUpright) return std::nullopt;
    SurfaceMap map(OdometryConfig{}.voxel);
    map.insert(a);
    const Registration found = best_registration(map, points, starts_of(a, b), tilt);
    PlaceOffset offset;
    offset.at = place;
    offset.shift = found.T_map_sensor.translation();
    const Eigen::Matrix3d turn = found.T_map_sensor.linear();
    offset.yaw = std::atan2(turn(1, 0), turn(0, 0));
    const Information covariance = covariance_of(found.information);
    offset.information = flat_information(covariance);
    offset.fit = found.inliers;
    offset.motion = found.T_map_sensor;
    offset.of_motion = covariance.inverse();
    return offset;
}

}  // namespace dynamic_filter::io
