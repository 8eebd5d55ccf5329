// SPDX-License-Identifier: MIT
#include "base/plugin.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "dynamic_filter/error.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

std::optional<fs::path> find_plugin(const char* name) {
    const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
    for (const fs::path& place : {folder, folder / ".." / DYNAMIC_FILTER_PLUGINS}) {
        if (fs::exists(place / name)) return place / name;
    }
    return std::nullopt;
}

}  // namespace

Plugin::Plugin(const PluginFile& file, std::string_view version, bool global) : file_(file) {
    const std::optional<fs::path> path = find_plugin(file.name);
    if (!path) {
        throw ConfigError(
            fmt::format("{0}: there is no {1}; install the package {2} (apt-get install {2}), or "
                        "build with {3} installed",
                        file.option, file.name, file.package, file.to_build));
    }
    handle_ = dlopen(path->c_str(), RTLD_NOW | (global ? RTLD_GLOBAL : RTLD_LOCAL));
    if (handle_ == nullptr) {
        throw ConfigError(fmt::format("{}: the plug-in cannot be loaded ({}); is {} installed?",
                                      file.option, dlerror(), file.to_load));
    }
    const std::string_view found = function<const char*()>(file.version_of)();
    if (found == version) return;
    throw ConfigError(
        fmt::format("{}: is of version {}, and the command is of {}; install the same version of "
                    "both",
                    path->string(), found, version));
}

void* Plugin::symbol(const char* name) const {
    void* const found = dlsym(handle_, name);
    if (found != nullptr) return found;
    throw ConfigError(
        fmt::format("{}: is no plug-in of this command, because it has no {}", file_.name, name));
}

}  // namespace dynamic_filter::app
