// SPDX-License-Identifier: MIT
#include "recorder.hpp"

#include "commands.hpp"
#include "dynamic_filter/io/messages.hpp"

namespace dynamic_filter::live {

std::filesystem::path recording_of(const std::filesystem::path& output,
                                   io::MessageEncoding encoding) {
    std::filesystem::path bag = output.lexically_normal();
    if (bag.filename().empty()) bag = bag.parent_path();  // "out/"
    bag += encoding == io::MessageEncoding::ros1 ? ".bag" : ".mcap";
    return bag;
}

Recorder::Recorder(const std::filesystem::path& bag) : writer_(io::BagWriter::create(bag)) {}

void Recorder::add(const LiveScan& scan) {
    const io::MessageEncoding encoding = writer_->encoding();
    const auto write_pose = [&](double stamp, const Pose& pose) {
        if (stamp <= last_pose_) return;
        last_pose_ = stamp;
        // Points in the world's frame have no frame of the sensor.
        const std::string child = scan.frame == scan.world ? "sensor" : scan.frame;
        writer_->write({"/odometry", "nav_msgs/Odometry", encoding}, io::to_nanoseconds(stamp),
                       io::odometry_message(scan.world, child, pose, stamp, encoding));
    };
    writer_->write({"/points", "sensor_msgs/PointCloud2", encoding}, scan.stamp_ns,
                   io::cloud_message(scan.cloud, scan.stamp, scan.frame, encoding));
    if (!scan.has_pose) return;
    if (last_pose_ > scan.stamp + 1.0) last_pose_ = -1.0;  // the clock was set back
    write_pose(scan.stamp, scan.T_world_sensor);
    for (std::size_t i = 0; i < scan.trajectory.stamps.size(); ++i) {
        write_pose(scan.trajectory.stamps[i], scan.trajectory.poses[i]);
    }
}

void Recorder::commit() { writer_->commit(); }

int finish_recording(const std::filesystem::path& bag, const std::filesystem::path& output,
                     const LiveConfig& config, bool without_poses, bool overwrite, bool quiet) {
    app::RunOptions run;
    run.data.data = bag;
    run.output = output;
    run.overwrite = overwrite;
    run.quiet = quiet;
    run.after = "live";
    run.threads = config.limits.threads;
    run.refine = config.filter.odometry.refine ? "on" : "off";
    run.data.deskew = config.input.deskew ? "on" : "off";
    if (without_poses) run.data.open.poses = "none";
    visit(config.filter, [&](const Setting& setting, const auto&) {
        if (!in_force(config.filter, setting)) return;
        const std::string key(setting.key);
        run.config.assignments.push_back(key + "=" + get(config.filter, key));
    });
    return app::run(run);
}

}  // namespace dynamic_filter::live
