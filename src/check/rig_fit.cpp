// SPDX-License-Identifier: MIT
#include "check/rig_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/degree.hpp"
#include "base/numbers.hpp"
#include "check/pieces.hpp"
#include "check/scan_input.hpp"
#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/parallel.hpp"
#include "geometry/pose.hpp"
#include "recording/recording_parts.hpp"
#include "recording/rig_poses.hpp"
#include "tracking/registration.hpp"
#include "tracking/scan_sample.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kRigPlaces = 10;
constexpr std::size_t kLeastFitting = 3;
constexpr std::size_t kAround = 8, kEverySecond = 2;  // scans of the first sensor before and after
constexpr double kRigReach = 1.0;                     // [m]
constexpr double kOneRadian = 10.0;                   // [m] turns move points at this distance

/// What registration says at one place.
struct PlaceFit {
    Pose T_vehicle_sensor;
    Twist velocity;  // of the sensor, per second
    double sharper;
};

double size_of_twist(const Twist& t) {
    return t.head<3>().norm() + kOneRadian * t.tail<3>().norm();
}

/// The surfaces that the first sensor shows around a time, in a frame near the vehicle.
SurfaceMap surfaces_around(const Recording& first, double stamp, const Pose& T_world_map,
                           const OdometryConfig& config) {
    SurfaceMap map(config.voxel);
    const auto& stamps = first.info().stamps;
    const auto middle = std::lower_bound(stamps.begin(), stamps.end(), stamp) - stamps.begin();
    const auto reach = static_cast<std::ptrdiff_t>(kAround);
    const std::ptrdiff_t end = std::min(middle + reach + 1, std::ssize(stamps));
    for (std::ptrdiff_t i = std::max(middle - reach, std::ptrdiff_t{0}); i < end;
         i += static_cast<std::ptrdiff_t>(kEverySecond)) {
        const auto k = static_cast<std::size_t>(i);
        const auto scan = read_scan(first, k);
        if (!scan) continue;
        const Points points =
            sample_for_map(scan->points, scan->times, config).at_stamp(velocity_at(first, k));
        map.insert(moved(points, T_world_map.inverse() * scan->T_world_sensor));
    }
    return map;
}

/// T_world_vehicle by the poses of the first sensor's scans.
std::optional<Pose> vehicle_near(const Recording& first, double stamp) {
    const RigSensor& sensor = first.parts().rig[first.parts().sensors.front()];
    const Pose at = poses_near({first.info().stamps, first.info().T_world_sensor}, {stamp}).front();
    if (!at.matrix().allFinite()) return std::nullopt;
    return at * sensor.T_vehicle_sensor->inverse();
}

/// Turns of the sensor about its own axes from which registration cannot come back by itself.
std::vector<Pose> other_mountings() {
    std::vector<Pose> turns;
    for (const Eigen::Vector3d& angles :
         {Eigen::Vector3d(0, 0, 180), Eigen::Vector3d(0, 0, 90), Eigen::Vector3d(0, 0, -90),
          Eigen::Vector3d(180, 0, 0), Eigen::Vector3d(180, 0, 180)}) {
        turns.push_back(placed(Eigen::Vector3d::Zero(), angles));
    }
    return turns;
}

/// `given`: T_vehicle_sensor of the rig file; `start`: where the search begins, which looks at
/// other mountings as well if that is the given place.
std::optional<PlaceFit> fit_at(const Recording& first, const Recording& other, std::size_t i,
                               const Pose& given, const Pose& start, const OdometryConfig& config) {
    constexpr double kMappedShare = 0.25, kLyingShare = 0.6, kClearlyLess = 0.8;
    const auto scan = read_scan(other, i);
    // The poses of the sensor's own recording say nothing of its place on the vehicle.
    const std::optional<Pose> vehicle = scan ? vehicle_near(first, scan->stamp) : std::nullopt;
    if (!vehicle || !scan->T_world_sensor.matrix().allFinite()) return std::nullopt;
    const Pose& T_world_vehicle = *vehicle;
    const SurfaceMap map = surfaces_around(first, scan->stamp, T_world_vehicle, config);
    if (map.empty()) return std::nullopt;
    const Twist velocity = velocity_at(other, i);
    const ScanSample sample = sample_for_map(scan->points, scan->times, config);
    const Points points = sample_for_registration(sample, config).at_stamp(velocity);
    const double blur = blur_on_map(map, points, given);
    Registration best = register_points(map, points, start, {}, kRigReach);
    double least = blur_on_map(map, points, best.T_map_sensor);
    const bool is_given = start.isApprox(given);
    for (const Pose& turn : is_given ? other_mountings() : std::vector<Pose>{}) {
        const Registration found = register_points(map, points, start * turn, {}, kRigReach);
        const double its = blur_on_map(map, points, found.T_map_sensor);
        if (its >= kClearlyLess * least) continue;
        best = found;
        least = its;
    }
    if (best.mapped < kMappedShare || best.inliers < kLyingShare * best.mapped) return std::nullopt;
    return PlaceFit{best.T_map_sensor, velocity, blur / least};
}

/// The place that is nearest to all others.
Pose middle_of(const std::vector<PlaceFit>& fits) {
    const Pose* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const PlaceFit& a : fits) {
        double sum = 0.0;
        for (const PlaceFit& b : fits) {
            sum += size_of_twist(log(a.T_vehicle_sensor.inverse() * b.T_vehicle_sensor));
        }
        if (sum >= least) continue;
        least = sum;
        best = &a.T_vehicle_sensor;
    }
    return *best;
}

/// Calls of(fit) for each place; the median of the answers.
template <class Of>
double median_of(const std::vector<PlaceFit>& fits, const Of& of) {
    std::vector<double> values;
    for (const PlaceFit& fit : fits) values.push_back(of(fit));
    return median(std::move(values));
}

SensorFit summary_of(const std::vector<PlaceFit>& fits, const Pose& given) {
    const Pose middle = middle_of(fits);
    Twist mean = Twist::Zero();
    for (int k = 0; k < 6; ++k) {
        mean[k] = median_of(fits, [&](const PlaceFit& fit) {
            return log(middle.inverse() * fit.T_vehicle_sensor)[k];
        });
    }
    SensorFit out{.fitting = fits.size(), .T_vehicle_sensor = middle * exp(mean)};
    const Pose off = given.inverse() * out.T_vehicle_sensor;
    out.shift = off.translation().norm();
    out.turn = log(off).tail<3>().norm();
    const auto rest = [&](const PlaceFit& fit) {
        return log(out.T_vehicle_sensor.inverse() * fit.T_vehicle_sensor);
    };
    const auto displaced = [&](const PlaceFit& fit) {
        return log(given.inverse() * fit.T_vehicle_sensor);
    };
    out.spread_of_shift =
        median_of(fits, [&](auto& fit) { return rest(fit).template head<3>().norm(); });
    out.spread_of_turn =
        median_of(fits, [&](auto& fit) { return rest(fit).template tail<3>().norm(); });
    out.left_by_place = median_of(fits, [&](auto& fit) { return size_of_twist(rest(fit)); });
    out.sharper = median_of(fits, [](auto& fit) { return fit.sharper; });
    // The same time is missing everywhere: least squares.
    Twist weight;
    weight << 1.0, 1.0, 1.0, kOneRadian, kOneRadian, kOneRadian;
    double of_both = 0.0, of_velocity = 0.0;
    for (const PlaceFit& fit : fits) {
        const Twist v = weight.cwiseProduct(fit.velocity);
        of_both += v.dot(weight.cwiseProduct(displaced(fit)));
        of_velocity += v.squaredNorm();
    }
    if (of_velocity > 0.0) out.delay = of_both / of_velocity;
    out.left_by_delay = median_of(
        fits, [&](auto& fit) { return size_of_twist(displaced(fit) - out.delay * fit.velocity); });
    out.moved_by_delay =
        median_of(fits, [&](auto& fit) { return size_of_twist(out.delay * fit.velocity); });
    return out;
}

/// The places at which the scans fit.
std::vector<PlaceFit> fit_places(const Recording& first, const Recording& other, const Pose& given,
                                 const Pose& start, const OdometryConfig& config) {
    const std::size_t places = std::min(kRigPlaces, other.size());
    std::vector<std::optional<PlaceFit>> fits(places);
    parallel_for(places, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t i = (2 * k + 1) * other.size() / (2 * places);
            fits[k] = fit_at(first, other, i, given, start, config);
        }
    });
    std::vector<PlaceFit> good;
    for (const auto& fit : fits) {
        if (fit) good.push_back(*fit);
    }
    return good;
}

std::optional<SensorFit> fit_sensor(const Recording& first, const Recording& other,
                                    const Pose& given, const OdometryConfig& config) {
    constexpr double kFarOff = 20.0 * kDegree;
    const auto from = [&](const Pose& start) -> std::optional<SensorFit> {
        const std::vector<PlaceFit> fits = fit_places(first, other, given, start, config);
        if (fits.size() < kLeastFitting) return std::nullopt;
        SensorFit fit = summary_of(fits, given);
        fit.places = std::min(kRigPlaces, other.size());
        return fit;
    };
    std::optional<SensorFit> fit = from(given);
    // From far off, registration ends in the right place at some places only.
    if (fit && fit->turn > kFarOff) {
        if (auto again = from(fit->T_vehicle_sensor)) fit = again;
    }
    return fit;
}

/// "[0.8, 0, 0.02]": rounded to the step, without minus signs of zeros.
std::string list_text(const Eigen::Vector3d& values, double step) {
    const auto rounded = [&](double value) { return std::round(value / step) * step + 0.0; };
    return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", rounded(values.x()), rounded(values.y()),
                       rounded(values.z()));
}

std::string place_text(const Pose& T_vehicle_sensor) {
    return fmt::format("at = {} and turn = {}", list_text(T_vehicle_sensor.translation(), 0.001),
                       list_text(angles_of(T_vehicle_sensor.linear()), 0.01));
}

/// True if the scans clearly lie better elsewhere.
bool is_off(const SensorFit& fit) {
    constexpr double kLeastShift = 0.04, kLeastTurn = 0.3 * kDegree, kLeastSharper = 1.03;
    const double few = 3.0 / std::sqrt(static_cast<double>(fit.fitting));
    return fit.sharper > kLeastSharper &&
           (fit.shift > std::max(kLeastShift, few * fit.spread_of_shift) ||
            fit.turn > std::max(kLeastTurn, few * fit.spread_of_turn));
}

std::optional<Finding> finding_of(const SensorFit& fit, const RigSensor& sensor,
                                  const std::string& first) {
    const std::string& name = sensor.name;
    constexpr double kClearly = 0.7, kLeastDelay = 0.004;  // [s]
    const bool may_be_late =
        std::abs(fit.delay) > kLeastDelay && fit.left_by_delay < kClearly * fit.moved_by_delay;
    const bool is_late = may_be_late && fit.left_by_delay < kClearly * fit.left_by_place;
    if (!is_late && !is_off(fit)) return std::nullopt;
    const std::string where = fmt::format("at {} of {} places", fit.fitting, fit.places);
    const std::string clock =
        fmt::format("clock = {:.3f}", std::round(1e3 * (sensor.clock + fit.delay)) / 1e3 + 0.0);
    if (is_late) {
        return Finding{fmt::format("the clock of sensor '{}' is not that of '{}': its scans lie on "
                                   "those of '{}' if its stamps are {:.0f} ms {}, {}",
                                   name, first, first, 1e3 * std::abs(fit.delay),
                                   fit.delay > 0.0 ? "later" : "earlier", where),
                       fmt::format("write {} for it in the rig file", clock)};
    }
    std::string what = fmt::format(
        "sensor '{}' is not where the rig file says: its scans lie on those of '{}' if it is moved "
        "by {:.0f} cm and turned by {:.1f} deg, {}",
        name, first, 100.0 * fit.shift, fit.turn / kDegree, where);
    std::string advice =
        fmt::format("write {} for it in the rig file", place_text(fit.T_vehicle_sensor));
    if (may_be_late) advice += fmt::format("; or its clock is another one: {}", clock);
    return Finding{std::move(what), std::move(advice)};
}

}  // namespace

std::vector<std::optional<SensorFit>> fit_sensors(const Recording& rig,
                                                  const OdometryConfig& config) {
    const std::vector<Recording> sensors = by_sensor(rig);
    std::vector<std::optional<SensorFit>> fits;
    for (std::size_t s = 1; s < sensors.size(); ++s) {
        const std::size_t sensor = sensors[s].parts().sensors.front();
        fits.push_back(fit_sensor(sensors.front(), sensors[s],
                                  *rig.parts().rig[sensor].T_vehicle_sensor, config));
    }
    return fits;
}

RigFindings misplaced_sensors(const Recording& rig, const OdometryConfig& config) {
    if (!knows_places(rig.parts()) || !rig.info().has_poses) return {};
    const auto fits = fit_sensors(rig, config);
    std::optional<std::vector<std::optional<SensorFit>>> fits_in_time;
    const std::vector<Recording> sensors = by_sensor(rig);
    const auto sensor_of = [&](std::size_t s) -> const RigSensor& {
        return rig.parts().rig[sensors[s].parts().sensors.front()];
    };
    RigFindings found;
    for (std::size_t s = 1; s < sensors.size(); ++s) {
        if (!fits[s - 1]) {
            found.notes.push_back(
                fmt::format("sensor '{}' sees too little of what '{}' sees at the same time to "
                            "tell whether it is where the rig file says",
                            sensor_of(s).name, sensor_of(0).name));
            continue;
        }
        const SensorFit& fit = *fits[s - 1];
        const auto finding = finding_of(fit, sensor_of(s), sensor_of(0).name);
        if (!finding) continue;
        // Motion during scans that is not undone displaces them as well.
        if (!fits_in_time) {
            fits_in_time = rig.info().deskewed ? fits : fit_sensors(with_times(rig), config);
        }
        const std::optional<SensorFit>& fit_in_time = (*fits_in_time)[s - 1];
        if (!fit_in_time) continue;
        const auto in_time = finding_of(*fit_in_time, sensor_of(s), sensor_of(0).name);
        if (!in_time) continue;
        found.findings.push_back(fit_in_time->shift < fit.shift ? *in_time : *finding);
    }
    return found;
}

}  // namespace dynamic_filter::io
