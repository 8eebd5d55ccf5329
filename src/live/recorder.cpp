// SPDX-License-Identifier: MIT
#include "live/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "run/run.hpp"

namespace dynamic_filter::live {

namespace {

namespace fs = std::filesystem;

fs::path without_slash(const fs::path& folder) {
    const fs::path path = folder.lexically_normal();
    return path.filename().empty() ? path.parent_path() : path;
}

}  // namespace

Recorder::Recorder(const fs::path& output, io::MessageEncoding encoding, bool overwrite,
                   bool several)
    : output_(without_slash(output)),
      encoding_(encoding),
      overwrite_(overwrite),
      several_(several) {
    if (overwrite_ || !is_taken(output_)) return;
    throw ConfigError(fmt::format("{} or {}: exists; choose another --record, or --overwrite",
                                  output_.string(), bag_of(output_).string()));
}

fs::path Recorder::bag_of(const fs::path& output) const {
    fs::path bag = output;
    bag += encoding_ == io::MessageEncoding::ros1 ? ".bag" : ".mcap";
    return bag;
}

bool Recorder::is_taken(const fs::path& output) const {
    const bool has_folder = fs::is_directory(output) ? !fs::is_empty(output) : fs::exists(output);
    return has_folder || fs::exists(bag_of(output));
}

void Recorder::begin() {
    fs::path current = output_;
    const auto is_used = [&] {
        const bool own = std::find(written_.begin(), written_.end(), current) != written_.end();
        return own || (!overwrite_ && is_taken(current));
    };
    for (int n = 2; is_used(); ++n) {
        current = output_;
        current += fmt::format("-{}", n);
    }
    writer_ = io::BagWriter::create(bag_of(current));
    written_.push_back(current);
    last_scan_.clear();
    last_pose_.clear();
}

void Recorder::add(const LiveScan& scan) {
    const auto last = last_scan_.find(scan.frame);
    if (writer_ != nullptr && last != last_scan_.end() && scan.stamp <= last->second) {
        writer_->commit();
        writer_.reset();
    }
    if (writer_ == nullptr) begin();
    last_scan_[scan.frame] = scan.stamp;
    writer_->write({"/points", "sensor_msgs/PointCloud2", encoding_}, scan.stamp_ns,
                   io::cloud_message(scan.cloud, scan.stamp, scan.frame, encoding_));
    if (!scan.has_pose) return;
    write_pose(scan, scan.stamp, scan.T_world_sensor);
    for (std::size_t i = 0; i < scan.trajectory.stamps.size(); ++i) {
        write_pose(scan, scan.trajectory.stamps[i], scan.trajectory.poses[i]);
    }
}

void Recorder::write_pose(const LiveScan& scan, double stamp, const Pose& T_world_sensor) {
    const auto [last, is_first] = last_pose_.try_emplace(scan.frame, stamp);
    if (!is_first && stamp <= last->second) return;
    last->second = stamp;
    // Points in the world's frame have no frame of the sensor.
    const std::string child = scan.frame == scan.world ? "sensor" : scan.frame;
    if (several_) {
        writer_->write({"/tf", "tf2_msgs/TFMessage", encoding_}, io::to_nanoseconds(stamp),
                       io::transform_message(scan.world, child, T_world_sensor, stamp, encoding_));
        return;
    }
    writer_->write({"/odometry", "nav_msgs/Odometry", encoding_}, io::to_nanoseconds(stamp),
                   io::odometry_message(scan.world, child, T_world_sensor, stamp, encoding_));
}

std::vector<fs::path> Recorder::commit() {
    if (writer_ != nullptr) writer_->commit();
    writer_.reset();
    return written_;
}

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
    if (without_poses) run.data.poses = "none";
    if (!config.input.mask.empty()) run.data.mask = config.input.mask;
    visit(config.filter, [&](const Setting& setting, const auto&) {
        if (!in_force(config.filter, setting)) return;
        const std::string key(setting.key);
        run.config.assignments.push_back(key + "=" + get(config.filter, key));
    });
    return app::run(run).exit_code;
}

}  // namespace dynamic_filter::live
