// SPDX-License-Identifier: MIT
/// @file
/// Simulated scenes with exact labels: a crowd (Sec. IV-A), a street, a square, a hall, a traffic
/// jam, a street with a queue, a platform, a yard where things move slowly, a hall with mirrors,
/// and a city for long drives on several days. Embree casts the rays. Each point knows the kind of
/// object on which it lies; errors are tabulated by kind.
///
/// - Units: [m], [s], [deg].
/// - Frames: points in the sensor frame, poses T_world_sensor; the z axis of the world points up.
/// - Shapes: arrays of a scan are parallel.
/// - Ownership: values.
/// - Threads: a Simulation has a single caller (it uses parallel_for inside).
/// - Errors: ConfigError.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::sim {

/// Kinds of objects. People are `walking` or `standing`, depending on what they do at that moment.
enum class Kind : std::uint8_t {
    ground,      ///< floor, pavement, kerbs, tops of steps and ramps
    structure,   ///< buildings, blocks, furniture, parked cars
    thin,        ///< less than about 0.3 m across: poles, signs, railings, trunks
    vegetation,  ///< leaves
    walking,     ///< people on foot who move at that moment
    standing,    ///< people on foot who stand still at that moment
    vehicle,     ///< vehicles and cyclists that move, or that halt on their way
    temporary,  ///< what rests during a drive, but is absent from another: parked cars, site fences
    reflection  ///< what was seen in a mirror: the point lies behind it, where nothing is
};

/// Names of the kinds, indexed by the value of Kind.
constexpr std::array<std::string_view, 9> kind_names = {"ground",     "structure", "thin",
                                                        "vegetation", "walking",   "standing",
                                                        "vehicle",    "temporary", "reflection"};

/// True for the kinds whose points are labelled dynamic, because they do not belong into the static
/// map; all other points are labelled static.
constexpr bool is_dynamic(Kind kind) { return kind >= Kind::walking; }

/// Options of a simulation.
struct SimulationOptions {
    std::string scene = "crowd";   ///< one of scene_names()
    std::string sensor = "vlp16";  ///< one of sensor_names()
    /// -1: the default of the scene (crowd: 100). In the city: at most so many per street and
    /// passage.
    int pedestrians = -1;
    std::uint64_t seed = 1;  ///< the same seed gives the same bytes
    /// Number of scans; empty: the whole scene (crowd: two rounds).
    std::optional<std::size_t> frames;
    double rate_hz = 0.0;  ///< [Hz] scans per second; 0: the default of the scene
    /// [m] standard deviation of the noise of each axis of the written positions.
    double pose_noise_m = 0.0;
    /// [deg] standard deviation of the noise about each rotation axis.
    double pose_noise_deg = 0.0;
    /// True: points are measured one after the other during the time between two scans (0.2 s at
    /// most), while the sensor and the objects move, as with a real rotating sensor. False: all
    /// points of a scan are measured at once.
    bool sweep = false;
    /// Of the robot, in scenes where it goes in rounds; 0: the default of the scene.
    int rounds = 0;
    /// [km] length of the drive, in scenes with several drives (city), up to 80; 0: 1 km.
    double km = 0.0;
    /// Number of drives of which this is one, in such scenes, up to 1000; 0: 3. It decides what is
    /// labelled dynamic (parked cars that are absent from another drive), and nothing else.
    int drives = 0;
    /// Which of the drives, from 1; 0: the first. All drives of a seed are in one world frame.
    int drive = 0;
    /// Of this sensor in the frame that the scene's only sensor would have: one of several sensors
    /// of a vehicle. The same scene with another mount is what another sensor sees at that time.
    Pose mount = Pose::Identity();
    double delay = 0.0;  ///< [s] stamp of the first scan, less than the time between two scans
};

/// One simulated sweep with its ground truth.
struct SimulatedScan {
    /// [m] Returns in the sensor frame. With SimulationOptions::sweep, each point is in the frame
    /// that the sensor had when it measured the point.
    Points points;
    std::vector<float> intensity;  ///< 0..1, parallel to the points
    Labels labels;                 ///< exact ground truth, parallel: static or dynamic
    std::vector<Kind> kinds;       ///< parallel
    /// Parallel: number of the person or vehicle, from 1; 0: neither. A reflection has the number
    /// of what is seen in the mirror. A thing of Kind::temporary has the same number in all drives;
    /// those that move are numbered on their own, for each drive.
    std::vector<std::uint16_t> instances;
    Pose T_world_sensor;  ///< as a SLAM system would report it (with pose noise, if asked for)
    double stamp = 0.0;   ///< [s] since the scene began; the sweep begins at this time
    /// With `sweep`: [s] relative to the stamp, parallel; otherwise empty.
    std::vector<float> times;
};

std::vector<std::string> scene_names();   ///< values of SimulationOptions::scene
std::vector<std::string> sensor_names();  ///< values of SimulationOptions::sensor

/// Number of drives that the options ask for: 0 in scenes without several drives. Throws
/// ConfigError if the scene is unknown.
int drive_count(const SimulationOptions& options);

/// Simulates scans. The same options give the same bytes. The constructor throws ConfigError if the
/// scene or sensor is unknown (the message lists the choices), if more frames are asked for than
/// the scene has, or if rounds are given for a scene without rounds, or drives for one without
/// drives. scan() may be called in any order.
class Simulation {
public:
    explicit Simulation(const SimulationOptions& options);  ///< builds the scene
    ~Simulation();
    Simulation(Simulation&&) noexcept;  ///< the moved-from object can only be destroyed

    [[nodiscard]] std::size_t size() const;           ///< number of scans
    [[nodiscard]] SimulatedScan scan(std::size_t i);  ///< returns scan i; i < size()
    /// T_world_sensor at a time [s] since the scene began, without the noise of
    /// SimulatedScan::T_world_sensor. May run in several threads.
    [[nodiscard]] Pose exact_pose(double time) const;

private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace dynamic_filter::sim
