// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

namespace dynamic_filter::app {

/// A folder that one process fills. Creates it, refuses one that holds something (ConfigError)
/// unless `overwrite`, which removes what an earlier run left there and nothing else. Locked while
/// it lives: a second process gets a ConfigError. Throws OutputError if it cannot be made.
class OutputFolder {
public:
    OutputFolder(std::filesystem::path path, bool overwrite);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Creates and returns a folder inside.
    [[nodiscard]] std::filesystem::path subfolder(const char* name) const;

private:
    /// Lives and dies on its own, so that a constructor that throws gives it back.
    struct Lock {
        std::filesystem::path file;
        int descriptor = -1;
        explicit Lock(const std::filesystem::path& folder);
        ~Lock();
    };
    std::filesystem::path path_;
    std::optional<Lock> lock_;
};

/// `results/<UTC stamp>`, not yet existing; `results/latest` will point to it after link_latest().
std::filesystem::path default_output();
void link_latest(const std::filesystem::path& output);

}  // namespace dynamic_filter::app
