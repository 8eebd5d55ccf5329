// SPDX-License-Identifier: MIT
#include "recording/folders.hpp"

#include <algorithm>

#include "base/natural_order.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

bool present(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

std::string extension_of(const fs::path& path) { return to_lower(path.extension().string()); }

fs::path whole_path(const fs::path& path) {
    std::error_code ignored;
    const fs::path whole = fs::absolute(path, ignored).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

fs::path without_slash(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

fs::path parent_of(const fs::path& folder) {
    std::error_code ignored;
    const fs::path parent = without_slash(folder).parent_path();
    if (!parent.empty() && folder.filename() != "." && folder.filename() != "..") return parent;
    return without_slash(fs::absolute(folder, ignored)).parent_path();
}

const std::vector<std::string>& usual_scan_folders() {
    static const std::vector<std::string> names = {"Scans",  "scans",    "pcds", "pcd",
                                                   "clouds", "velodyne", "."};
    return names;
}

Paths list_files(const fs::path& folder, const std::set<std::string>& extensions,
                 std::error_code& error) {
    Paths files;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::path& path = entry->path();
        const bool wanted = extensions.contains(extension_of(path));
        if (wanted && !path.filename().string().starts_with('.') && !is_folder(path)) {
            files.push_back(path);
        }
    }
    sort_naturally(files);
    return files;
}

Paths list_files(const fs::path& folder, const std::set<std::string>& extensions) {
    std::error_code error;
    Paths files = list_files(folder, extensions, error);
    if (error) throw InputError(folder, "", "cannot be listed: " + error.message());
    return files;
}

Paths list_folders(const fs::path& folder) {
    Paths folders;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (is_folder(entry->path())) folders.push_back(entry->path());
    }
    std::sort(folders.begin(), folders.end());
    return folders;
}

}  // namespace dynamic_filter::io
