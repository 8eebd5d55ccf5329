// SPDX-License-Identifier: MIT
#include "live/map_saver.hpp"

#include <fmt/format.h>

#include <csignal>
#include <span>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"

namespace dynamic_filter::live {

namespace {

volatile std::sig_atomic_t save_is_wanted = 0;

extern "C" void note_save_request(int) { save_is_wanted = 1; }

io::Cloud cloud_of(const std::vector<StaticVoxel>& voxels) {
    io::Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) io::add_field(cloud, axis, io::FieldType::f64);
    io::add_field(cloud, "probability", io::FieldType::f32);
    for (const StaticVoxel& voxel : voxels) {
        const auto center = std::as_bytes(std::span(voxel.center.data(), 3));
        const auto probability = std::as_bytes(std::span(&voxel.probability, 1));
        cloud.data.insert(cloud.data.end(), center.begin(), center.end());
        cloud.data.insert(cloud.data.end(), probability.begin(), probability.end());
    }
    return cloud;
}

/// Says what came of it.
std::string saved(const Session& session, const std::filesystem::path& file) {
    const std::vector<StaticVoxel> voxels = session.static_map();
    if (voxels.empty()) return "no scan was judged yet, so no map is saved";
    try {
        io::write_cloud(file, cloud_of(voxels));
        return fmt::format("saved {}: {} points, {} bytes", file.string(), voxels.size(),
                           std::filesystem::file_size(file));
    } catch (const std::exception& error) {  // the filter goes on
        return fmt::format("the map is not saved: {}", error.what());
    }
}

}  // namespace

void catch_save_requests() {
    save_is_wanted = 0;
    std::signal(SIGUSR1, note_save_request);
}

MapSaver::MapSaver(Session& session, std::filesystem::path file)
    : session_(session), file_(std::move(file)) {
    if (io::can_write_cloud(file_)) return;
    throw ConfigError(
        fmt::format("--map {}: expected a file of {}", file_.string(), io::cloud_kinds_written()));
}

void MapSaver::run() {
    constexpr auto kNow = std::chrono::seconds(0);
    if (running_.valid() && running_.wait_for(kNow) != std::future_status::ready) return;
    take_result();
    if (save_is_wanted == 0) return;
    save_is_wanted = 0;
    running_ = std::async(std::launch::async, [this] { return saved(session_, file_); });
}

void MapSaver::save() {
    take_result();
    notices_.push_back(saved(session_, file_));
}

void MapSaver::take_result() {
    if (running_.valid()) notices_.push_back(running_.get());
}

std::vector<std::string> MapSaver::pop_notices() { return std::exchange(notices_, {}); }

}  // namespace dynamic_filter::live
