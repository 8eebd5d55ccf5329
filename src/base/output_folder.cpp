// SPDX-License-Identifier: MIT
#include "base/output_folder.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <functional>
#include <utility>
#include <vector>

#include "dynamic_filter/error.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

constexpr const char *kLock = ".lock", *kBeside = ".new";

/// Left by a process that was killed while it wrote.
bool is_stale(const fs::path& file) {
    const std::string name = file.filename();
    return name.front() == '.' && name.find(".tmp.") != std::string::npos;
}

void remove_files(const fs::path& folder, const std::function<bool(const fs::path&)>& which) {
    std::vector<fs::path> doomed;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (which(entry.path())) doomed.push_back(entry.path());
    }
    for (const fs::path& file : doomed) fs::remove(file);
}

/// Folders of folders, each with what a run leaves.
constexpr std::array kOfResults{"drives", "history"};

std::vector<fs::path> inner_results(const fs::path& path, const FolderFiles& written) {
    std::vector<fs::path> inner;
    if (!written.is_result) return inner;
    for (const char* name : kOfResults) {
        if (!fs::is_directory(path / name)) continue;
        for (const auto& entry : fs::directory_iterator(path / name)) {
            if (entry.is_directory()) inner.push_back(entry.path());
        }
    }
    return inner;
}

void remove_earlier_output(const fs::path& path, const FolderFiles& written) {
    for (const char* name : written.files) fs::remove(path / name);
    for (const auto& [name, suffix] : written.folders) {
        if (!fs::is_directory(path / name)) continue;
        remove_files(path / name,
                     [&, s = suffix](const fs::path& file) { return file.extension() == s; });
        if (fs::is_empty(path / name)) fs::remove(path / name);
    }
    for (const fs::path& inner : inner_results(path, written)) {
        remove_earlier_output(inner, written);
        if (fs::is_empty(inner)) fs::remove(inner);
    }
    if (!written.is_result) return;
    for (const char* name : kOfResults) {
        if (fs::is_directory(path / name) && fs::is_empty(path / name)) fs::remove(path / name);
    }
}

/// Folders at the new place may hold files of the user, which stay.
void move_into(const fs::path& from, const fs::path& to) {
    if (!fs::is_directory(from)) {
        fs::rename(from, to);
        return;
    }
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from)) {
        move_into(entry.path(), to / entry.path().filename());
    }
}

/// Removes files that a killed process left half-written.
void remove_stale(const fs::path& path, const FolderFiles& written) {
    remove_files(path, is_stale);
    for (const auto& [name, suffix] : written.folders) {
        if (fs::is_directory(path / name)) remove_files(path / name, is_stale);
    }
    for (const fs::path& inner : inner_results(path, written)) remove_stale(inner, written);
}

/// Whether the descriptor is still the file of that name: another process may have removed it.
bool is_current(int descriptor, const fs::path& file) {
    struct stat held {
    }, named{};
    return fstat(descriptor, &held) == 0 && stat(file.c_str(), &named) == 0 &&
           held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

bool holds_something(const fs::path& path) {
    for (const auto& entry : fs::directory_iterator(path)) {
        const fs::path name = entry.path().filename();
        if (name != kLock && name != kBeside) return true;
    }
    return false;
}

/// Refuses to replace the result of a run by the output of another command. Some of its files would
/// stay and mislead.
void refuse_result_of_a_run(const fs::path& folder, const FolderFiles& written) {
    if (written.is_result || !fs::exists(folder / kRunState)) return;
    throw ConfigError(folder.string() +
                      ": holds the result of a run, which only a run may overwrite; choose "
                      "another folder");
}

}  // namespace

OutputFolder::Lock::Lock(const fs::path& folder) : file(folder / kLock) {
    do {
        if (descriptor >= 0) close(descriptor);
        descriptor = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
        if (descriptor < 0) throw OutputError(file, std::strerror(errno));
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            close(descriptor);
            throw ConfigError(folder.string() + ": another run is writing here; choose another -o");
        }
    } while (!is_current(descriptor, file));
}

OutputFolder::Lock::~Lock() {
    std::error_code ignored;
    fs::remove(file, ignored);
    close(descriptor);
}

OutputFolder::OutputFolder(fs::path path, const FolderFiles& files, Existing existing)
    : path_(std::move(path)), files_(files) {
    if (path_.empty()) throw ConfigError("the output folder has no name; give one with -o");
    try {
        if (fs::exists(path_) && !fs::is_directory(path_)) {
            throw ConfigError(path_.string() + ": the output must be a folder, and this is a file");
        }
        made_ = fs::create_directories(path_);
        lock_.emplace(path_);
        remove_stale(path_, files_);
        if (existing == Existing::resume) {
            if (!fs::exists(path_ / kBeside)) return;
            beside_ = path_ / kBeside;
            remove_stale(beside_, files_);
            return;
        }
        fs::remove_all(path_ / kBeside);  // of a process that was killed
        const bool empty = !holds_something(path_);
        if (!empty && existing == Existing::refuse) {
            throw ConfigError(path_.string() +
                              ": the folder is not empty; choose another -o, or --overwrite");
        }
        refuse_result_of_a_run(path_, files_);
        if (empty && files_.is_of_use_in_part) return;
        beside_ = path_ / kBeside;
        fs::create_directory(beside_);
    } catch (const fs::filesystem_error& error) {
        throw OutputError(path_, error.code().message());
    }
}

void OutputFolder::commit() {
    if (beside_.empty()) return;
    try {
        remove_earlier_output(path_, files_);
        move_into(beside_, path_);
        fs::remove_all(beside_);
        beside_.clear();
        made_ = false;
    } catch (const fs::filesystem_error& error) {
        throw OutputError(path_, error.code().message());
    }
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    if (!beside_.empty()) fs::remove_all(beside_, ignored);
    lock_.reset();
    if (made_) fs::remove(path_, ignored);  // where nothing is in it
}

bool OutputFolder::is_empty() const { return !holds_something(path()); }

fs::path OutputFolder::subfolder(const char* name) const {
    std::error_code error;
    fs::create_directories(path() / name, error);
    if (error) throw OutputError(path() / name, error.message());
    return path() / name;
}

void refuse_existing(const fs::path& output, bool overwrite) {
    if (overwrite || !fs::exists(output)) return;
    throw ConfigError(output.string() + ": exists; choose another -o, or --overwrite");
}

void refuse_same_folder(const fs::path& input, const fs::path& output, const std::string& what) {
    std::error_code ignored;
    if (fs::equivalent(input, output, ignored)) {
        throw ConfigError(output.string() + ": " + what + "; choose another -o");
    }
}

void link_or_copy(const fs::path& from, const fs::path& to) {
    try {
        fs::remove(to);
        std::error_code cannot_link;
        fs::create_hard_link(from, to, cannot_link);
        if (cannot_link) fs::copy_file(from, to);
    } catch (const fs::filesystem_error& error) {
        throw OutputError(to, error.code().message());
    }
}

fs::path default_output() {
    const auto stamp = fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(std::time(nullptr)));
    fs::path path = fs::path("results") / stamp;
    for (int n = 2; fs::exists(path); ++n)
        path = fs::path("results") / fmt::format("{}-{}", stamp, n);
    return path;
}

bool link_latest(const fs::path& output) {
    const fs::path link = output.parent_path() / "latest", fresh = output.parent_path() / ".latest";
    std::error_code error;
    fs::remove(fresh, error);
    fs::create_symlink(output.filename(), fresh, error);
    if (!error) fs::rename(fresh, link, error);  // replaces the old link in one step
    return !error;
}

}  // namespace dynamic_filter::app
