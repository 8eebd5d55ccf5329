// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <span>

#include "commands.hpp"
#include "dynamic_filter/io/writers.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "write_simulation.hpp"

namespace dynamic_filter::app {

namespace {

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

}  // namespace

std::size_t write_simulation(const sim::SimulationOptions& options,
                             const std::filesystem::path& folder, bool quiet) {
    sim::Simulation simulation(options);
    const auto scans = folder / (options.sweep ? "scans" : "velodyne");
    std::filesystem::create_directories(scans);
    std::filesystem::create_directories(folder / "labels");
    std::vector<Pose> poses;
    std::vector<double> stamps;
    std::size_t points = 0;
    Progress progress("simulate", simulation.size(), quiet);
    for (std::size_t i = 0; i < simulation.size() && !interrupted(); ++i) {
        const sim::SimulatedScan scan = simulation.scan(i);
        const std::string stem = fmt::format("{:06}", i);
        if (options.sweep) {
            io::write_pcd(scans / (stem + ".pcd"), timed_cloud(scan));
        } else {
            io::write_bin(scans / (stem + ".bin"), scan.points, scan.intensity);
        }
        io::write_labels(folder / "labels" / (stem + ".label"), scan.labels);
        poses.push_back(scan.T_world_sensor);
        stamps.push_back(scan.stamp);
        points += scan.points.size();
        progress.advance();
    }
    io::write_poses_kitti(folder / "poses.txt", poses);
    io::write_times(folder / "times.txt", stamps);
    return points;
}

int simulate(const SimulateOptions& o) {
    OutputFolder output(o.output, Contents::recording, replaced_if(o.overwrite));
    catch_interrupts();
    const std::size_t points = write_simulation(o.simulation, output.path(), o.quiet);
    output.commit();
    if (!o.quiet) fmt::print("written  {} ({} points)\n", output.name().string(), points);
    return interrupted() ? kInterrupted : kDone;
}

}  // namespace dynamic_filter::app
