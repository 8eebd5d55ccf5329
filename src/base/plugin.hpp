// SPDX-License-Identifier: MIT
/// Libraries that the command loads only when an option asks for them, so that it depends on little
/// and starts fast.
#pragma once

#include <string_view>

namespace dynamic_filter::app {

struct PluginFile {
    const char* option;      ///< that asks for it: "--mpi"
    const char* name;        ///< of the file
    const char* package;     ///< of Debian, which brings it
    const char* to_build;    ///< package that building it needs
    const char* to_load;     ///< package that loading it needs
    const char* version_of;  ///< name of its function that returns its version
};

/// A plug-in of the command. It stays loaded, because what it loads cannot always be unloaded.
class Plugin {
public:
    /// Looks beside the command, as a build leaves it, and where it is installed. `global`: others
    /// that the plug-in loads find its symbols. Throws ConfigError if there is none, if it cannot
    /// be loaded, or if it is not of `version`.
    Plugin(const PluginFile& file, std::string_view version, bool global);

    /// The function of that name. Throws ConfigError if the plug-in has none.
    template <typename Function>
    [[nodiscard]] Function* function(const char* name) const {
        return reinterpret_cast<Function*>(symbol(name));
    }

private:
    [[nodiscard]] void* symbol(const char* name) const;

    const PluginFile& file_;
    void* handle_ = nullptr;
};

}  // namespace dynamic_filter::app
