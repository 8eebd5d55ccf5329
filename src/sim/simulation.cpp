// SPDX-License-Identifier: MIT
#include "dynamic_filter/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamic_filter/error.hpp"
#include "sim/degree.hpp"
#include "sim/lidar.hpp"
#include "sim/portable.hpp"
#include "sim/prototypes.hpp"
#include "sim/random.hpp"
#include "sim/scene.hpp"

namespace dynamic_filter::sim {
namespace {

constexpr int most_pedestrians = 1000;
constexpr int most_rounds = 100;
constexpr double longest_drive = 80.0;  // [km] the parked cars of longer ones had too few numbers
constexpr int most_drives = 1000;
constexpr double longest_sweep = 0.2;  // [s]

template <typename Entry>
std::vector<std::string> names(const std::vector<Entry>& table) {
    std::vector<std::string> out;
    out.reserve(table.size());
    for (const Entry& entry : table) out.push_back(entry.name);
    return out;
}

template <typename Entry>
const Entry& find(const std::vector<Entry>& table, const char* what, const std::string& name) {
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const Entry& e) { return e.name == name; });
    if (found != table.end()) return *found;
    std::string choices;
    for (const Entry& entry : table) choices += (choices.empty() ? "" : ", ") + entry.name;
    throw ConfigError(std::string("unknown ") + what + " \"" + name + "\": choose one of " +
                      choices);
}

void check(const SimulationOptions& options) {
    if (options.pedestrians < -1 || options.pedestrians > most_pedestrians) {
        throw ConfigError("pedestrians is " + std::to_string(options.pedestrians) +
                          ": expected 0 to " + std::to_string(most_pedestrians) +
                          ", or -1 for the scene's own number");
    }
    if (options.rounds < 0 || options.rounds > most_rounds) {
        throw ConfigError("rounds is " + std::to_string(options.rounds) + ": expected 1 to " +
                          std::to_string(most_rounds) + ", or 0 for the scene's own number");
    }
    const auto reject_unless_positive = [](const char* name, double value) {
        if (!std::isfinite(value) || value < 0.0) {
            throw ConfigError(std::string(name) + " is " + std::to_string(value) +
                              ": expected a finite number of at least 0");
        }
    };
    reject_unless_positive("rate_hz", options.rate_hz);
    reject_unless_positive("pose_noise_m", options.pose_noise_m);
    reject_unless_positive("pose_noise_deg", options.pose_noise_deg);
    reject_unless_positive("km", options.km);
    reject_unless_positive("delay", options.delay);
}

/// The scenes for which `has` holds, for a message.
template <typename Has>
std::string scenes_that(const Has& has) {
    std::string names;
    for (const SceneEntry& entry : scene_table()) {
        if (has(entry)) names += (names.empty() ? "" : ", ") + entry.name;
    }
    return names;
}

/// The drive that is asked for; throws if the scene has none, or if it is not among them.
Trip trip_of(const SimulationOptions& options, const SceneEntry& entry) {
    if (!entry.make_trip) {
        if (options.km == 0.0 && options.drives == 0 && options.drive == 0) return {};
        throw ConfigError("the scene \"" + entry.name +
                          "\" has no drives, so it takes neither km nor drives; the scenes with "
                          "drives: " +
                          scenes_that([](const SceneEntry& e) { return bool(e.make_trip); }));
    }
    Trip trip;
    if (options.km > 0.0) trip.km = options.km;
    if (options.drives != 0) trip.drives = options.drives;
    if (options.drive != 0) trip.drive = options.drive;
    if (trip.km > longest_drive || trip.km < 0.01) {
        throw ConfigError("km is " + std::to_string(trip.km) + ": expected 0.01 to " +
                          std::to_string(static_cast<int>(longest_drive)));
    }
    if (trip.drives < 1 || trip.drives > most_drives) {
        throw ConfigError("drives is " + std::to_string(trip.drives) + ": expected 1 to " +
                          std::to_string(most_drives));
    }
    if (trip.drive < 1 || trip.drive > trip.drives) {
        throw ConfigError("drive is " + std::to_string(trip.drive) + ": expected 1 to " +
                          std::to_string(trip.drives) + ", the number of drives");
    }
    return trip;
}

std::vector<Part> all_parts(const Scene& scene) {
    std::vector<Part> parts;
    std::uint16_t instance = 0;
    const auto add_instance = [&](std::vector<Part> more) {
        ++instance;
        for (Part& part : more) part.instance = instance;
        parts.insert(parts.end(), more.begin(), more.end());
    };
    for (std::size_t i = 0; i < scene.walkers.size(); ++i) {
        add_instance(walker_parts(i, scene.walkers[i].luggage));
    }
    for (const Vehicle& vehicle : scene.vehicles) add_instance(vehicle_parts(vehicle));
    return parts;
}

/// Duration [s] of the requested number of rounds.
double duration_of(const Scene& scene, const SceneEntry& entry, int rounds) {
    if (rounds == 0) return scene.duration;
    if (entry.rounds > 0) return scene.duration * rounds / entry.rounds;
    throw ConfigError("rounds is " + std::to_string(rounds) + ": in the scene \"" + entry.name +
                      "\" the robot does not go in rounds; it does in " +
                      scenes_that([](const SceneEntry& e) { return e.rounds > 0; }));
}

/// The requested number of scans; throws if the scene has fewer.
std::size_t scan_count(const SimulationOptions& options, double duration, double rate_hz) {
    const auto full = static_cast<std::size_t>(duration * rate_hz + 1e-6);
    const std::size_t scans = options.frames.value_or(full);
    if (scans > full) {
        throw ConfigError("frames is " + std::to_string(scans) + ": the scene \"" + options.scene +
                          "\" has " + std::to_string(full) +
                          " scans; ask for fewer, or for more per second (rate_hz)" +
                          (options.km > 0.0 ? ", or for more km" : ""));
    }
    if (scans == 0) throw ConfigError("frames is 0; ask for 1 or more");
    return scans;
}

Crowd simulated_crowd(const Scene& scene, double duration) {
    if (scene.walkers.empty()) return {};
    const auto movers = [&scene](double t) {
        std::vector<Mover> out;
        const PathPoint p = at(scene.robot.path, travelled(scene.robot, t));
        out.push_back({p.position, speed_at(scene.robot, t) * p.direction, scene.robot_radius});
        for (const Vehicle& vehicle : scene.vehicles) add_movers(vehicle, t, out);
        return out;
    };
    const CrowdPlan plan{.walkers = scene.walkers,
                         .field = distance_field(scene.obstacles, scene.low, scene.high),
                         .movers = movers};
    return simulate_crowd(plan, duration);
}

Pose rotated(const Pose& pose, const Eigen::Vector3d& rotation_vector) {
    const double angle = rotation_vector.norm();
    Pose out = pose;
    if (angle > 0.0)
        out.linear() =
            pose.linear() * Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
    return out;
}

Pose vehicle_pose(const Scene& scene, double t) {
    const PathPoint p = at(scene.robot.path, travelled(scene.robot, t));
    Pose pose = Pose::Identity();
    pose.linear() << p.direction.x(), -p.direction.y(), 0.0, p.direction.y(), p.direction.x(), 0.0,
        0.0, 0.0, 1.0;
    pose.translation() = Eigen::Vector3d(p.position.x(), p.position.y(), scene.sensor_height);
    // Wheels on paving stones: a few tenths of a degree of roll and pitch.
    constexpr double sway = 0.2 * std::numbers::pi / 180.0;
    return rotated(pose, {sway * portable_sincos(2.1 * t).sin,
                          sway * portable_sincos(1.3 * t + 1.0).sin, 0.0});
}

Pose noisy_pose(const Pose& pose, const SimulationOptions& options, std::size_t scan) {
    Eigen::Matrix<double, 6, 1> draws;
    for (int k = 0; k < 6; ++k) {
        draws[k] = normal(hash(hash(options.seed, 0x905e), scan, static_cast<std::uint64_t>(k)));
    }
    Pose out = rotated(pose, options.pose_noise_deg * degree * draws.tail<3>());
    out.translation() += options.pose_noise_m * draws.head<3>();
    return out;
}

}  // namespace

struct Simulation::World {
    SimulationOptions options;
    const Sensor& sensor;
    Scene scene;
    Caster caster;
    double rate_hz = 1.0;
    std::size_t scans = 0;
    Crowd crowd;
    /// Of a scene that is too large to be cast as a whole.
    std::function<Placements(double)> near_placements = {};

    /// Lets the caster hold what can be seen at that time.
    void gather(double t) {
        if (!scene.around) return;
        Surroundings near = scene.around(t, sensor.max_range);
        caster.replace(std::move(near.parts));
        near_placements = std::move(near.placements);
    }

    [[nodiscard]] Placements placements(double t) const {
        if (near_placements) return near_placements(t);
        Placements out;
        for (std::size_t i = 0; i < scene.walkers.size(); ++i) {
            Stride stride = stride_at(crowd, i, t);
            const double ground = scene.ground ? scene.ground(stride.position.cast<double>()) : 0.0;
            if (scene.carried) {
                stride.position += scene.carried(stride.position.cast<double>(), t).cast<float>();
            }
            place_walker(scene.walkers[i], stride, ground, out);
        }
        for (const Vehicle& vehicle : scene.vehicles) place_vehicle(vehicle, t, out);
        return out;
    }

    [[nodiscard]] Pose true_pose(double t) const { return vehicle_pose(scene, t) * options.mount; }

    [[nodiscard]] double sweep_duration() const { return std::min(1.0 / rate_hz, longest_sweep); }

    /// Simulates scan i, which is taken (or begins) at t [s].
    Returns returns(std::size_t i, double t, const Pose& pose) {
        gather(t);
        if (!options.sweep) {
            caster.place(placements(t));
            return sense(caster, sensor, pose, options.seed, i);
        }
        const auto time = [&](double share) { return t + share * sweep_duration(); };
        return dynamic_filter::sim::sweep(
            caster, sensor, [&](double share) { return true_pose(time(share)); },
            [&](double share) { caster.place(placements(time(share))); }, options.seed, i);
    }
};

std::vector<std::string> scene_names() { return names(scene_table()); }
std::vector<std::string> sensor_names() { return names(sensor_table()); }

int drive_count(const SimulationOptions& options) {
    const SceneEntry& entry = find(scene_table(), "scene", options.scene);
    return entry.make_trip ? trip_of(options, entry).drives : 0;
}

Simulation::Simulation(const SimulationOptions& options) {
    check(options);
    const SceneEntry& entry = find(scene_table(), "scene", options.scene);
    const Sensor& sensor = find(sensor_table(), "sensor", options.sensor);
    const Trip trip = trip_of(options, entry);
    const int people = options.pedestrians < 0 ? entry.pedestrians : options.pedestrians;
    Scene scene = entry.make_trip ? entry.make_trip(people, options.seed, trip)
                                  : entry.make(people, options.seed);
    const double rate = options.rate_hz > 0.0 ? options.rate_hz : entry.rate_hz;
    const std::size_t scans = scan_count(options, duration_of(scene, entry, options.rounds), rate);
    if (options.delay >= 1.0 / rate) {
        throw ConfigError("delay is " + std::to_string(options.delay) +
                          ": expected less than the time between two scans, " +
                          std::to_string(1.0 / rate) + " s");
    }
    Crowd crowd = simulated_crowd(scene, static_cast<double>(scans) / rate + options.delay);
    std::vector<Mesh> copied = scene.around ? std::move(scene.prototypes) : prototypes();
    // The mesh of the static parts is large, so only the caster keeps it.
    world_.reset(new World{options, sensor, scene,
                           Caster(scene.still, std::move(copied), all_parts(scene)), rate, scans,
                           std::move(crowd)});
    world_->scene.still = {};
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

std::size_t Simulation::size() const { return world_->scans; }

Pose Simulation::exact_pose(double time) const {
    return Eigen::Translation3d(0.0, 0.0, world_->scene.floor) * world_->true_pose(time);
}

SimulatedScan Simulation::scan(std::size_t i) {
    const SimulationOptions& options = world_->options;
    const double t = options.delay + static_cast<double>(i) / world_->rate_hz;
    const Pose vehicle = vehicle_pose(world_->scene, t);
    Returns returns = world_->returns(i, t, vehicle * options.mount);
    std::vector<float> times;
    if (options.sweep) {
        const auto duration = static_cast<float>(world_->sweep_duration());
        for (const float share : returns.shares) times.push_back(share * duration);
    }
    return {.points = std::move(returns.points),
            .intensity = std::move(returns.intensity),
            .labels = std::move(returns.labels),
            .kinds = std::move(returns.kinds),
            .instances = std::move(returns.instances),
            .T_world_sensor = Eigen::Translation3d(0.0, 0.0, world_->scene.floor) *
                              noisy_pose(vehicle, options, i) * options.mount,
            .stamp = t,
            .times = std::move(times)};
}

}  // namespace dynamic_filter::sim
