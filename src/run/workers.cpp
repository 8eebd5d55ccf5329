// SPDX-License-Identifier: MIT
#include "run/workers.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>

#include "dynamic_filter/error.hpp"
#include "run/mpi/plugin.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

constexpr const char* kPlugin = "libdynamicfilter_mpi.so";

class Alone final : public Workers {
public:
    int rank() const override { return 0; }
    int size() const override { return 1; }

    std::optional<std::size_t> next(std::size_t count) override {
        if (failed_) return std::nullopt;
        const std::size_t task = taken_++;
        if (task >= count) return std::nullopt;
        return task;
    }

    bool all_done(bool well) override {
        failed_ = failed_ || !well;
        taken_ = 0;
        return well;
    }

private:
    std::atomic<std::size_t> taken_ = 0;
    std::atomic<bool> failed_ = false;
};

/// Beside the command, as a build leaves it, or where it is installed; the first that exists.
std::optional<fs::path> find_plugin() {
    const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
    for (const fs::path& place : {folder, folder / ".." / DYNAMIC_FILTER_PLUGINS}) {
        if (fs::exists(place / kPlugin)) return place / kPlugin;
    }
    return std::nullopt;
}

/// The function of that name. Throws ConfigError if the plug-in has none.
template <typename Function>
Function* function_of(void* plugin, const char* name, const fs::path& file) {
    void* const found = dlsym(plugin, name);
    if (!found) {
        throw ConfigError(fmt::format("{}: is no plug-in of this command, because it has no {}",
                                      file.string(), name));
    }
    return reinterpret_cast<Function*>(found);
}

}  // namespace

std::unique_ptr<Workers> alone() { return std::make_unique<Alone>(); }

std::unique_ptr<Workers> mpi_workers() {
    const std::optional<fs::path> file = find_plugin();
    if (!file) {
        throw ConfigError(fmt::format(
            "--mpi: there is no {}; install the package dynamicfilter-mpi (apt-get install "
            "dynamicfilter-mpi), or build with libopenmpi-dev installed",
            kPlugin));
    }
    // Open MPI loads parts of itself that expect its symbols among those of the whole process. It
    // cannot be unloaded, so nobody closes the handle.
    void* const plugin = dlopen(file->c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (!plugin) {
        throw ConfigError(fmt::format(
            "--mpi: the plug-in cannot be loaded ({}); is openmpi-bin installed?", dlerror()));
    }
    const std::string_view version = function_of<mpi::Version>(plugin, mpi::kVersion, *file)();
    if (version != DYNAMIC_FILTER_VERSION) {
        throw ConfigError(fmt::format(
            "{}: is of version {}, and the command is of {}; install the same version of both",
            file->string(), version, DYNAMIC_FILTER_VERSION));
    }
    const char* fault = nullptr;
    std::unique_ptr<Workers> workers(function_of<mpi::Make>(plugin, mpi::kMake, *file)(&fault));
    if (!workers) throw ConfigError(fmt::format("--mpi: {}", fault));
    return workers;
}

}  // namespace dynamic_filter::app
