// SPDX-License-Identifier: MIT
#include "recording/scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <map>
#include <numeric>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "geometry/pose.hpp"
#include "recording/mask.hpp"

namespace dynamic_filter::app {

namespace {

io::PoseFix pose_fix_of(const std::string& name) {
    for (const io::PoseFix fix : io::pose_fixes()) {
        if (io::to_string(fix) == name) return fix;
    }
    return io::PoseFix::none;
}

double seconds_of(const std::string& unit) {
    static const std::map<std::string, double> units = {
        {"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
    return units.at(unit);
}

double metres_of(const std::string& unit) {
    static const std::map<std::string, double> units = {
        {"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"feet", 0.3048}};
    return units.at(unit);
}

}  // namespace

void require_extension(const std::filesystem::path& output, const std::string& extension) {
    if (output.extension() == extension) return;
    throw ConfigError(output.string() + ": the name of what is written must end in " + extension);
}

io::Recording open(const DataOptions& options) {
    refuse_invalid(options, Asker::command);
    io::OpenOptions how{.layout = options.format,
                        .poses = options.poses,
                        .first = options.first,
                        .last = options.last,
                        .stride = options.stride,
                        .topic = options.topic,
                        .pose_topic = options.pose_topic,
                        .deskew = options.deskew == "on",
                        .pose_fix = pose_fix_of(options.pose_fix),
                        .points_in_world = options.points_in_world,
                        .time_unit = seconds_of(options.time_unit),
                        .sensor_at = place_of(options.sensor_at),
                        .point_unit = metres_of(options.point_unit)};
    if (options.mask && *options.mask != kNoMask) how.own_body = io::read_mask(*options.mask);
    if (how.poses == std::filesystem::path(kNoPoses)) {
        how.poses.reset();
        how.without_poses = true;
    }
    io::Recording recording = io::open_recording(options.data, how);
    if (how.pose_fix != io::PoseFix::none && !recording.info().has_poses) {
        throw ConfigError("--pose-fix " + options.pose_fix +
                          " has no poses to correct; give them with --poses FILE");
    }
    return recording;
}

std::vector<std::size_t> all_scans(const io::Recording& recording) {
    std::vector<std::size_t> scans(recording.size());
    std::iota(scans.begin(), scans.end(), std::size_t{0});
    return scans;
}

InputError changed_in_use(const io::Recording& recording, std::size_t i, const std::string& why) {
    const std::string file = recording.info().scan_files[i].string();
    const bool names_it = why.starts_with(file + ": ");
    return {file, "", "changed while it was in use: " + why.substr(names_it ? file.size() + 2 : 0)};
}

void for_each_scan(const io::Recording& recording, const std::vector<std::size_t>& scans,
                   const std::function<void(std::size_t, MaybeScan&)>& prepare,
                   const std::function<bool(std::size_t, MaybeScan&)>& use) {
    constexpr std::size_t kAhead = 8;
    const auto read = [&](std::size_t i, MaybeScan& maybe) {
        try {
            maybe.scan = recording.read(scans[i]);
            if (prepare) prepare(scans[i], maybe);
        } catch (const InputError& error) {
            maybe = {std::nullopt, error.what()};
        }
    };
    const auto read_batch = [&, threads = current_threads()](std::size_t first) {
        std::vector<MaybeScan> batch(std::min(kAhead, scans.size() - first));
        with_threads(threads, [&] {
            parallel_for(batch.size(), 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) read(first + i, batch[i]);
            });
        });
        return batch;
    };
    // With one thread, the batch is read when it is needed.
    const auto when = current_threads() > 1 ? std::launch::async : std::launch::deferred;
    std::future<std::vector<MaybeScan>> next;  // its destructor waits
    const auto begin_batch = [&](std::size_t first) {
        if (first < scans.size()) next = std::async(when, read_batch, first);
    };
    begin_batch(0);
    for (std::size_t first = 0; first < scans.size(); first += kAhead) {
        std::vector<MaybeScan> batch = next.get();
        begin_batch(first + kAhead);
        for (std::size_t i = 0; i < batch.size(); ++i) {
            if (!use(scans[first + i], batch[i])) return;
        }
    }
}

Scan moved_scan(io::FullScan& scan, std::size_t index) {
    return {std::move(scan.points), scan.T_world_sensor,   scan.stamp, index,
            scan.has_pose,          std::move(scan.times), scan.sensor};
}

Points shifted_world(const Points& points, const Pose& T_world_sensor,
                     const Eigen::Vector3d& origin) {
    const Eigen::Matrix3d rotation = T_world_sensor.linear();
    const Eigen::Vector3d translation = T_world_sensor.translation() - origin;
    Points shifted(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        shifted[i] = (rotation * points[i].cast<double>() + translation).cast<float>();
    }
    return shifted;
}

Points shifted_world(const io::FullScan& scan, const Eigen::Vector3d& origin) {
    return shifted_world(scan.points, scan.T_world_sensor, origin);
}

Points positions_from(const io::Cloud& cloud, const Eigen::Vector3d& origin) {
    Points points(cloud.size());
    for (const char axis : {'x', 'y', 'z'}) {
        const auto world = io::values(cloud, *cloud.find(std::string(1, axis)));
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i][axis - 'x'] = static_cast<float>(world[i] - origin[axis - 'x']);
        }
    }
    return points;
}

Eigen::Vector3d origin_of(const io::Cloud& cloud) {
    Pose near = Pose::Identity();
    const Points points = positions_from(cloud, Eigen::Vector3d::Zero());
    const auto finite =
        std::find_if(points.begin(), points.end(), [](const Point& p) { return p.allFinite(); });
    if (finite != points.end()) near.translation() = finite->cast<double>();
    return nearby_origin(near, 1.0);
}

Eigen::Vector3d scoring_origin(const io::Recording& recording, double voxel_size) {
    for (std::size_t i = 0; i < recording.size(); ++i) {
        try {
            return nearby_origin(recording.read(i).T_world_sensor, voxel_size);
        } catch (const InputError&) {
            continue;  // a rejected scan; the next will do
        }
    }
    return Eigen::Vector3d::Zero();
}

}  // namespace dynamic_filter::app
