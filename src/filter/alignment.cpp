// SPDX-License-Identifier: MIT
#include "filter/alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace dynamic_filter {

namespace {

constexpr std::size_t kSample = 400;                 // points of a scan
constexpr float kNearest = 2.0F, kFarthest = 30.0F;  // [m] farther surfaces are seen too sparsely
constexpr float kWidest = 1.0F;                      // [m] between the returns around a place
constexpr float kFlat = 0.1F;    // deviation from a plane, relative to that width
constexpr float kOther = 1.0F;   // [m] a place farther off lies on something else
constexpr float kShared = 0.2F;  // share of the sample on surfaces of the keyframe
constexpr double kMisfit = 0.1;  // [m] larger ones count less and less
constexpr double kStiff = 0.01;  // directions that no surface shows stay as they are
constexpr double kFarthestOff = 1.0, kMostTurned = 0.05;  // [m], [rad] more is no drift of poses
constexpr int kRounds = 5;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A point beside a surface of the keyframe: how far it is off, and how a motion changes that.
struct Misfit {
    double off;         // [m] along the normal
    Vector6 by_motion;  // derivative for a shift and a rotation vector in the sensor frame
};

Point position(const Beam& beam) {
    const float across = beam.range * std::cos(beam.elevation);
    return {across * std::cos(beam.azimuth), across * std::sin(beam.azimuth),
            beam.range * std::sin(beam.elevation)};
}

/// The nearest beams of the four quadrants around a place: [above][right].
using Corners = std::array<std::array<std::optional<Beam>, 2>, 2>;
Corners corners_around(const BeamImage& image, const Beam& place) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const ImageGrid& grid = image.grid();
    const float row = (place.elevation - grid.elevation_min) / grid.elevation_step;
    const float column = (place.azimuth + kPi) / grid.azimuth_step;
    const int first_row = static_cast<int>(std::floor(row)) - 1;
    const int first_column = static_cast<int>(std::floor(column)) - 1;
    Corners corners;
    std::array<std::array<float, 2>, 2> nearest{};
    for (int r = std::max(first_row, 0); r < std::min(first_row + 3, grid.rows); ++r) {
        for (int c = first_column; c < first_column + 3; ++c) {
            const int wrapped = c < 0 ? c + grid.columns : c >= grid.columns ? c - grid.columns : c;
            if (!image.has_beam(r, wrapped)) continue;
            const Beam beam = image.beam(r, wrapped);
            float right = beam.azimuth - place.azimuth;
            if (right > kPi) right -= 2.0F * kPi;
            if (right < -kPi) right += 2.0F * kPi;
            const float up = beam.elevation - place.elevation;
            const float apart =
                std::abs(right) / grid.azimuth_step + std::abs(up) / grid.elevation_step;
            auto& corner = corners[up > 0.0F][right > 0.0F];
            auto& least = nearest[up > 0.0F][right > 0.0F];
            if (corner && apart >= least) continue;
            corner = beam;
            least = apart;
        }
    }
    return corners;
}

/// Empty if the keyframe has no flat surface there.
std::optional<Misfit> misfit_at(const BeamImage& image, const Beam& place) {
    const auto [below, above] = corners_around(image, place);
    for (const auto& corner : {below[0], below[1], above[0], above[1]}) {
        if (!corner || std::abs(corner->range - place.range) > kOther + kWidest) return {};
    }
    const Point low = position(*below[0]), high = position(*above[1]);
    const Point beside = position(*below[1]), opposite = position(*above[0]);
    const Point rising = high - low, falling = opposite - beside;
    if (std::max(rising.norm(), falling.norm()) > kWidest) return {};
    const Point normal = rising.cross(falling).normalized();
    const Point middle = 0.25F * (low + high + beside + opposite);
    if (!(std::abs(normal.dot(low - middle)) <= kFlat * rising.norm())) return {};
    const Point at = position(place);
    const float off = normal.dot(at - middle);
    if (std::abs(off) > kOther) return {};
    Misfit misfit{.off = off, .by_motion = {}};
    misfit.by_motion << normal.cast<double>(), at.cross(normal).cast<double>();
    return misfit;
}

/// Robust cost (Cauchy) of what remains after a motion.
double cost(const std::vector<Misfit>& misfits, const Vector6& motion) {
    double sum = 0.0;
    for (const Misfit& m : misfits) {
        const double off = (m.off - m.by_motion.dot(motion)) / kMisfit;
        sum += std::log1p(off * off);
    }
    return sum;
}

/// The motion that explains the misfits, by reweighted least squares.
Vector6 motion_of(const std::vector<Misfit>& misfits) {
    Vector6 motion = Vector6::Zero();
    for (int round = 0; round < kRounds; ++round) {
        Matrix6 a = Matrix6::Identity() * (kStiff * static_cast<double>(misfits.size()));
        Vector6 b = Vector6::Zero();
        for (const Misfit& m : misfits) {
            const double left = (m.off - m.by_motion.dot(motion)) / kMisfit;
            const Vector6 weighted = m.by_motion / (1.0 + left * left);
            a.noalias() += weighted * m.by_motion.transpose();
            b += weighted * m.off;
        }
        motion = a.ldlt().solve(b);
    }
    return motion;
}

}  // namespace

Points alignment_sample(const Scan& scan) {
    const auto is_between = [](const Point& p) {
        return p.squaredNorm() > kNearest * kNearest && p.squaredNorm() < kFarthest * kFarthest;
    };
    const auto there =
        static_cast<std::size_t>(std::count_if(scan.points.begin(), scan.points.end(), is_between));
    const std::size_t every = std::max<std::size_t>(1, there / kSample);
    Points sample;
    std::size_t k = 0;
    for (const Point& p : scan.points) {
        if (!is_between(p) || k++ % every != 0) continue;
        sample.push_back((scan.T_world_sensor * p.cast<double>()).cast<float>());
    }
    return sample;
}

std::optional<Eigen::Isometry3f> alignment_to(const Keyframe& keyframe, const Points& sample,
                                              float gain) {
    Directions seen;
    to_spherical(sample, keyframe.T_sensor_map, seen);
    std::vector<Misfit> misfits;
    for (std::size_t i = 0; i < sample.size(); ++i) {
        if (!(seen.range[i] > kNearest && seen.range[i] < kFarthest)) continue;
        const auto misfit =
            misfit_at(keyframe.image, {seen.azimuth[i], seen.elevation[i], seen.range[i]});
        if (misfit) misfits.push_back(*misfit);
    }
    const float least = kShared * static_cast<float>(sample.size());
    if (misfits.empty() || static_cast<float>(misfits.size()) < least) return std::nullopt;
    const Vector6 motion = motion_of(misfits);
    if (motion.head<3>().norm() > kFarthestOff || motion.tail<3>().norm() > kMostTurned) return {};
    if (cost(misfits, motion) > (1.0 - gain) * cost(misfits, Vector6::Zero())) {
        return Eigen::Isometry3f::Identity();
    }
    Pose back = Pose::Identity();
    const Eigen::Vector3d rotation = motion.tail<3>();
    back.linear() =
        Eigen::AngleAxisd(-rotation.norm(), rotation.stableNormalized()).toRotationMatrix();
    back.translation() = -motion.head<3>();
    const Pose T_sensor_map = keyframe.T_sensor_map.cast<double>();
    return (T_sensor_map.inverse() * back * T_sensor_map).cast<float>();
}

}  // namespace dynamic_filter
