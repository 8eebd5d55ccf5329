// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace dynamic_filter::app {

/// What a command writes into its folder: all that --overwrite may remove.
struct FolderFiles {
    std::vector<const char*> files;
    /// Names of folders, and the suffix of the files in them; a folder may stand here several
    /// times.
    std::vector<std::pair<const char*, const char*>> folders{};
    /// True: what is there is of use before all is there. Half a recording or map would mislead
    /// whoever reads it.
    bool is_of_use_in_part = false;
    /// True: a run leaves these files, also in each folder of `drives` and `history`. No other
    /// command replaces them, because some of them would stay and mislead.
    bool is_result = false;
};

/// What becomes of an earlier result in the folder.
enum class Existing {
    refuse,   ///< ConfigError
    replace,  ///< keeps it until commit(), then removes what such a command writes, nothing else
    resume,   ///< goes on in the folder. If a killed run was replacing an older result, goes on
              ///< with the files that it had begun beside it.
};

/// The mark of a run: what it was begun with.
inline constexpr const char* kRunState = ".run";
inline Existing replaced_if(bool overwrite) {
    return overwrite ? Existing::replace : Existing::refuse;
}

/// Throws ConfigError if a file is there that must not be replaced.
void refuse_existing(const std::filesystem::path& output, bool overwrite);

/// A folder that one process fills. Locked while it lives: a second process gets a ConfigError.
/// Throws OutputError if it cannot be made.
class OutputFolder {
public:
    /// `files` must outlive the object.
    OutputFolder(std::filesystem::path path, const FolderFiles& files, Existing existing);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();

    /// Where to write: beside an earlier result, as long as there is one. Outputs that are useless
    /// in part are always written beside. Without commit() nothing of them is left.
    [[nodiscard]] const std::filesystem::path& path() const {
        return beside_.empty() ? path_ : beside_;
    }
    [[nodiscard]] const std::filesystem::path& name() const { return path_; }
    /// Replaces the earlier result by the new files. Without this call, the earlier result stays.
    void commit();
    /// Creates and returns a folder inside.
    [[nodiscard]] std::filesystem::path subfolder(const char* name) const;
    /// Whether path() holds anything yet.
    [[nodiscard]] bool is_empty() const;

private:
    /// Lives and dies on its own, so that a constructor that throws gives it back.
    struct Lock {
        std::filesystem::path file;
        int descriptor = -1;
        explicit Lock(const std::filesystem::path& folder);
        ~Lock();
    };
    std::filesystem::path path_, beside_;
    bool made_ = false;  ///< by us, so that it goes if nothing comes of it
    const FolderFiles& files_;
    std::optional<Lock> lock_;
};

/// Throws ConfigError if the output folder is the input folder; `what` the message says of it.
void refuse_same_folder(const std::filesystem::path& input, const std::filesystem::path& output,
                        const std::string& what = "holds the recording itself");

/// Replaces `to` by `from`. A link takes no space and lives on without `from`; where the file
/// system has none, the file is copied.
void link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

/// `results/<UTC stamp>`, not yet existing; `results/latest` will point to it after link_latest().
std::filesystem::path default_output();

/// False if the link could not be made (not every file system has them).
bool link_latest(const std::filesystem::path& output);

}  // namespace dynamic_filter::app
