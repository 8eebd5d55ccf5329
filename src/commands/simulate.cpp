// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <future>
#include <span>
#include <utility>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "base/text.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "commands/write_simulation.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/outputs.hpp"
#include "formats/knowable_file.hpp"
#include "formats/label_files.hpp"
#include "geometry/pose.hpp"
#include "sim/knowable.hpp"

namespace dynamic_filter::app {

namespace {

struct SimulateOptions {
    sim::SimulationOptions simulation;
    std::filesystem::path output;
    bool knowable = false, overwrite = false, quiet = false;
    std::string mount{};
};

/// The pose of "X,Y,Z,ROLL,PITCH,YAW". Throws ConfigError.
Pose mount_of(const std::string& text) {
    const std::vector<double> numbers = io::parse_reals(text);
    if (numbers.size() != 6) {
        throw ConfigError("--mount: '" + text +
                          "' is no mount; expected X,Y,Z in metres and ROLL,PITCH,YAW in degrees, "
                          "such as -0.5,0,0.2,0,10,180");
    }
    return placed({numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]});
}

/// x y z intensity t.
io::Cloud timed_cloud(const sim::SimulatedScan& scan) {
    io::Cloud cloud;
    for (const char* name : {"x", "y", "z", "intensity", "t"}) {
        io::add_field(cloud, name, io::FieldType::f32);
    }
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        const Point& p = scan.points[i];
        const std::array record = {p.x(), p.y(), p.z(), scan.intensity[i], scan.times[i]};
        const auto bytes = std::as_bytes(std::span(record));
        cloud.data.insert(cloud.data.end(), bytes.begin(), bytes.end());
    }
    return cloud;
}

/// The values of a label file.
std::vector<std::uint32_t> numbered_labels(const sim::SimulatedScan& scan) {
    constexpr std::uint32_t moving_other = 259;
    std::vector<std::uint32_t> out(scan.labels.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = scan.kinds[i] == sim::Kind::temporary
                     ? moving_other | std::uint32_t{scan.instances[i]} << 16U
                     : static_cast<std::uint32_t>(scan.labels[i]);
    }
    return out;
}

std::filesystem::path scan_folder(const sim::SimulationOptions& options,
                                  const std::filesystem::path& folder) {
    return folder / (options.sweep ? "scans" : "velodyne");
}

std::string stem_of(std::size_t scan) { return fmt::format("{:06}", scan); }

/// The names of the files become durable later, all at once.
void write_scan(const sim::SimulationOptions& options, const std::filesystem::path& folder,
                const std::string& stem, const sim::SimulatedScan& scan) {
    const auto scans = scan_folder(options, folder);
    if (options.sweep) {
        io::write_pcd(scans / (stem + ".pcd"), timed_cloud(scan));
    } else {
        io::write_bin(scans / (stem + ".bin"), scan.points, scan.intensity, io::Durable::contents);
    }
    io::write_numbered_labels(io::label_file(folder / "labels", stem), numbered_labels(scan),
                              io::Durable::contents);
}

/// Simulates the recording once more, because only now it is known where dynamic points lie. Leaves
/// nothing if it is interrupted.
void write_knowable(sim::Simulation& simulation, sim::Knowable& knowable,
                    const std::filesystem::path& recording, bool quiet) {
    Progress progress("look through", simulation.size(), quiet);
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        if (interrupted()) return;
        knowable.look(sim::exact_beams(simulation, simulation.scan(i)));
        progress.advance();
    }
    knowable.decide();
    const auto folder = io::knowable_folder(recording);
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        io::write_knowable(io::knowable_file(folder, stem_of(i)), knowable.of_scan(i),
                           io::Durable::contents);
    }
    io::sync_folder(folder);
}

}  // namespace

std::vector<SimulatedRecording> simulated_recordings(const sim::SimulationOptions& options,
                                                     const std::filesystem::path& folder) {
    const int drives = sim::drive_count(options);
    if (drives == 0) return {{options, folder}};
    std::vector<SimulatedRecording> out;
    for (int drive = 1; drive <= drives; ++drive) {
        out.push_back({options, folder / fmt::format("drive_{}", drive)});
        out.back().options.drives = drives;
        out.back().options.drive = drive;
    }
    return out;
}

std::size_t write_simulation(const sim::SimulationOptions& options,
                             const std::filesystem::path& folder, bool quiet, bool with_knowable) {
    sim::Simulation simulation(options);
    sim::Knowable knowable;
    const auto scans = scan_folder(options, folder);
    std::filesystem::create_directories(scans);
    std::filesystem::create_directories(folder / "labels");
    std::vector<Pose> poses;
    std::vector<double> stamps;
    std::size_t points = 0;
    Progress progress("simulate", simulation.size(), quiet);
    std::future<void> writing;  // of the last scan, while the next one is simulated
    for (std::size_t i = 0; i < simulation.size() && !interrupted(); ++i) {
        sim::SimulatedScan scan = simulation.scan(i);
        poses.push_back(scan.T_world_sensor);
        stamps.push_back(scan.stamp);
        points += scan.points.size();
        if (with_knowable) knowable.note(scan, sim::exact_beams(simulation, scan));
        if (writing.valid()) writing.get();
        writing = std::async(std::launch::async, [&options, &folder, i, done = std::move(scan)] {
            write_scan(options, folder, stem_of(i), done);
        });
        progress.advance();
    }
    if (writing.valid()) writing.get();
    io::sync_folder(scans);
    io::sync_folder(folder / "labels");
    io::write_poses_kitti(folder / "poses.txt", poses);
    io::write_times(folder / "times.txt", stamps);
    if (with_knowable && !interrupted()) write_knowable(simulation, knowable, folder, quiet);
    return points;
}

int simulate(const SimulateOptions& o) {
    catch_interrupts();
    sim::SimulationOptions simulation = o.simulation;
    if (!o.mount.empty()) simulation.mount = mount_of(o.mount);
    for (const auto& [options, folder] : simulated_recordings(simulation, o.output)) {
        if (interrupted()) break;
        OutputFolder output(folder, recording_files(), replaced_if(o.overwrite));
        const std::size_t points = write_simulation(options, output.path(), o.quiet, o.knowable);
        output.commit();
        if (!o.quiet) say("written  {} ({} points)\n", output.name().string(), points);
    }
    return interrupted() ? kInterrupted : kDone;
}

void add_simulate(Program& program) {
    Command c = program.command("simulate", "Simulate a recording with exact labels");
    const auto o = std::make_shared<SimulateOptions>();
    auto& s = o->simulation;
    c.choice("SCENE", s.scene, sim::scene_names(), "what to simulate").required();
    c.path("-o,--output", o->output, "output folder").required();
    c.whole("--pedestrians", s.pedestrians, {.high = 1e6},
            "number of pedestrians (default: the scene's own number)");
    c.whole("--seed", s.seed, {}, "seed of the random numbers; the same seed gives the same bytes");
    c.choice("--sensor", s.sensor, sim::sensor_names(), "LiDAR to simulate");
    c.whole("--frames", s.frames, {.low = 1}, "number of scans (default: the whole scene)");
    c.number("--rate", s.rate_hz, {0.0, 100.0}, "scans per second (default: the scene's own)");
    c.whole("--rounds", s.rounds, {1, 100},
            "rounds that the robot drives in the scene crowd (default: 2)");
    c.number("--km", s.km, {0.01, 80.0},
             "length of each drive [km], in the scene city: up to 80 (default: 1)");
    c.whole("--drives", s.drives, {1, 1000},
            "drives on different days, in the scene city (default: 3); they become OUTPUT/drive_1 "
            "and so on");
    c.text("--mount", o->mount,
           "X,Y,Z,ROLL,PITCH,YAW [m, deg] of this sensor in the frame of the scene's own sensor: "
           "another sensor on the same vehicle, in a recording of its own");
    c.number("--delay", s.delay, {0.0, 10.0}, "stamp of the first scan [s]; sensors take turns");
    c.flag("--sweep", s.sweep,
           "measure the points of a scan one after the other while everything moves, as a real "
           "sensor does; the scans are "
           "then PCD files with the time of each point");
    c.number("--pose-noise", s.pose_noise_m, {0.0, 10.0}, "standard deviation of each axis [m]");
    c.number("--pose-noise-deg", s.pose_noise_deg, {0.0, 90.0},
             "standard deviation of each axis [deg]");
    c.flag(
        "--knowable", o->knowable,
        "also write what could be known of each point: how often beams passed through its place, "
        "and whether somebody saw its thing move; `eval` reads it");
    c.flag("--overwrite", o->overwrite, "replace an earlier recording in the output folder");
    add_quiet(c, o->quiet);
    c.action([o] { return simulate(*o); });
}

}  // namespace dynamic_filter::app
