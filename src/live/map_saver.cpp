// SPDX-License-Identifier: MIT
#include "live/map_saver.hpp"

#include <fmt/format.h>

#include <csignal>
#include <utility>

#include "base/little_endian.hpp"
#include "base/output_folder.hpp"
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
        for (const double coordinate : voxel.center) app::put(cloud.data, coordinate);
        app::put(cloud.data, voxel.probability);
    }
    return cloud;
}

/// Whatever happens, the filter goes on.
Saved saved(const Session& session, const std::filesystem::path& file) {
    try {
        const std::vector<StaticVoxel> voxels = session.static_map();
        if (voxels.empty()) return {false, "nothing static is known yet, so no map is saved"};
        io::write_cloud(file, cloud_of(voxels));
        const std::uint64_t bytes = std::filesystem::file_size(file);
        return {true,
                fmt::format("saved {}: {} points, {} bytes", file.string(), voxels.size(), bytes),
                file, voxels.size(), bytes};
    } catch (const std::exception& error) {
        return {false, fmt::format("the map is not saved: {}", error.what())};
    }
}

}  // namespace

void catch_save_requests() {
    save_is_wanted = 0;
    std::signal(SIGUSR1, note_save_request);
}

MapSaver::MapSaver(Session& session, std::filesystem::path file, bool overwrite)
    : session_(session), file_(std::move(file)) {
    if (!io::can_write_cloud(file_)) {
        throw ConfigError(fmt::format("--map {}: expected a file of {}", file_.string(),
                                      io::cloud_kinds_written()));
    }
    const std::filesystem::path folder = std::filesystem::absolute(file_).parent_path();
    if (!std::filesystem::is_directory(folder)) {
        throw ConfigError("--map " + file_.string() + ": there is no folder " + folder.string());
    }
    app::refuse_existing(file_, overwrite);
}

std::uint64_t MapSaver::request(const std::string& name) {
    const std::lock_guard hold(lock_);
    wanted_ = name.empty() ? file_ : file_.parent_path() / name;
    return ++requests_;
}

std::string MapSaver::name_of(const std::string& path, const std::string& format) const {
    if (format.empty()) return path;
    const std::string end = (format.starts_with('.') ? "" : ".") + format;
    if (path.ends_with(end)) return path;
    return (path.empty() ? file_.stem().string() : path) + end;
}

/// Others on the network may ask: they get no farther than the folder of the user's own map.
std::string MapSaver::fault_of(const std::string& name) const {
    const std::filesystem::path path(name);
    if (path.has_parent_path() || name.starts_with('.') || name.size() > 200) {
        return fmt::format("'{}' is no name of a file beside {}", name, file_.string());
    }
    if (!io::can_write_cloud(path)) {
        return fmt::format("'{}': expected a file of {}", name, io::cloud_kinds_written());
    }
    return "";
}

void MapSaver::run() {
    constexpr auto kNow = std::chrono::seconds(0);
    if (running_.valid() && running_.wait_for(kNow) != std::future_status::ready) return;
    take_result();
    std::optional<std::filesystem::path> file;
    std::uint64_t request = 0;
    {
        const std::lock_guard hold(lock_);
        file = std::exchange(wanted_, std::nullopt);
        request = requests_;
    }
    if (save_is_wanted == 0 && !file) return;
    save_is_wanted = 0;
    running_ = std::async(std::launch::async, [this, request, to = file.value_or(file_)] {
        Saved result = saved(session_, to);
        result.request = request;
        return result;
    });
}

Saved MapSaver::save() {
    take_result();
    return saved(session_, file_);
}

void MapSaver::take_result() {
    if (running_.valid()) results_.push_back(running_.get());
}

std::vector<Saved> MapSaver::pop_results() { return std::exchange(results_, {}); }

}  // namespace dynamic_filter::live
