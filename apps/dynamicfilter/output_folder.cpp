// SPDX-License-Identifier: MIT
#include "output_folder.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "dynamic_filter/error.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

constexpr const char* kLock = ".lock";

/// What run, simulate and demo write: all that --overwrite may remove.
constexpr std::array kOwnFiles{"static_map.pcd", "dynamic_points.pcd", "metrics.json",
                               "timing.json",    "config.toml",        "run.log",
                               "poses.txt",      "times.txt"};
constexpr std::array kOwnFolders{"labels", "velodyne"};
constexpr std::array kOwnSuffixes{".label", ".bin"};

void remove_earlier_output(const fs::path& path) {
    for (const char* name : kOwnFiles) fs::remove(path / name);
    for (const char* name : kOwnFolders) {
        if (!fs::is_directory(path / name)) continue;
        for (const auto& entry : fs::directory_iterator(path / name)) {
            for (const char* suffix : kOwnSuffixes) {
                if (entry.path().extension() == suffix) fs::remove(entry.path());
            }
        }
        if (fs::is_empty(path / name)) fs::remove(path / name);
    }
}

bool holds_something(const fs::path& path) {
    for (const auto& entry : fs::directory_iterator(path)) {
        if (entry.path().filename() != kLock) return true;
    }
    return false;
}

}  // namespace

OutputFolder::Lock::Lock(const fs::path& folder) : file(folder / kLock) {
    descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (descriptor < 0) throw OutputError(file, std::strerror(errno));
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        close(descriptor);
        throw ConfigError(folder.string() + ": another run is writing here; choose another -o");
    }
}

OutputFolder::Lock::~Lock() {
    std::error_code ignored;
    fs::remove(file, ignored);
    close(descriptor);
}

OutputFolder::OutputFolder(fs::path path, bool overwrite) : path_(std::move(path)) {
    try {
        if (fs::exists(path_) && !fs::is_directory(path_)) {
            throw ConfigError(path_.string() + ": the output must be a folder, and this is a file");
        }
        fs::create_directories(path_);
        lock_.emplace(path_);
        if (holds_something(path_)) {
            if (!overwrite) {
                throw ConfigError(path_.string() +
                                  ": the folder is not empty; choose another -o, or --overwrite");
            }
            remove_earlier_output(path_);
        }
    } catch (const fs::filesystem_error& error) {
        throw OutputError(path_, error.code().message());
    }
}

OutputFolder::~OutputFolder() = default;

fs::path OutputFolder::subfolder(const char* name) const {
    std::error_code error;
    fs::create_directories(path_ / name, error);
    if (error) throw OutputError(path_ / name, error.message());
    return path_ / name;
}

fs::path default_output() {
    const auto stamp = fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(std::time(nullptr)));
    fs::path path = fs::path("results") / stamp;
    for (int n = 2; fs::exists(path); ++n)
        path = fs::path("results") / fmt::format("{}-{}", stamp, n);
    return path;
}

void link_latest(const fs::path& output) {
    const fs::path link = output.parent_path() / "latest", fresh = output.parent_path() / ".latest";
    std::error_code error;
    fs::remove(fresh, error);
    fs::create_symlink(output.filename(), fresh, error);
    if (!error) fs::rename(fresh, link, error);  // replaces the old link in one step
    if (error) throw OutputError(link, error.message());
}

}  // namespace dynamic_filter::app
