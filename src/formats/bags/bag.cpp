// SPDX-License-Identifier: MIT
#include "dynamic_filter/bag.hpp"

#include <algorithm>

#include "base/input.hpp"
#include "base/natural_order.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/bags/bag_file.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

using Open = std::unique_ptr<BagFile> (*)(const fs::path&);

/// Returns nullptr if the extension is not that of a bag.
Open opener_for(const fs::path& path) {
    const std::string name = to_lower(path.filename().string());
    if (name.ends_with(".mcap")) return open_mcap;
    if (name.ends_with(".bag") || name.ends_with(".bag.active")) return open_rosbag1;
    if (name.ends_with(".db3")) return open_rosbag2;
    return nullptr;
}

/// Chooses by the first bytes, for any file name; returns nullptr if the file is no bag.
Open opener_by_content(const fs::path& file) {
    const std::string kind = kind_by_content(read_head(file, 16));
    if (kind == "an MCAP bag") return open_mcap;
    if (kind == "a ROS 1 bag") return open_rosbag1;
    if (kind == "a ROS 2 bag") return open_rosbag2;
    return nullptr;
}

bool is_compressed_bag(const fs::path& path) {
    fs::path inner = path.filename();
    const std::string packing = to_lower(inner.extension().string());
    if (packing != ".zstd" && packing != ".zst") return false;
    return opener_for(inner.replace_extension()) != nullptr;
}

/// The bag files of a folder in the order of their names, which contain numbers. Only files of one
/// kind are returned, because a converted bag often lies beside the original.
std::vector<fs::path> bags_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::path& path = entry->path();
        const bool hidden = path.filename().string().starts_with('.');
        if (!hidden && (opener_for(path) != nullptr || is_compressed_bag(path))) {
            files.push_back(path);
        }
    }
    sort_naturally(files);
    return files;
}

void refuse_mixture(const std::vector<fs::path>& files, const fs::path& folder) {
    for (const fs::path& file : files) {
        if (is_compressed_bag(file)) {
            throw InputError(
                file, "",
                "is compressed as a whole; unpack it first with `zstd -d " + file.string() + "`");
        }
        if (opener_for(file) == opener_for(files.front())) continue;
        throw InputError(folder, "",
                         "holds " + files.front().filename().string() + " and " +
                             file.filename().string() + "; give the one to use");
    }
}

}  // namespace

std::string plain_type(const std::string& type) {
    for (const std::string_view middle : {"/msg/", "::msg::dds_::", "::msg::"}) {
        const std::size_t at = type.find(middle);
        if (at == std::string::npos) continue;
        std::string name = type.substr(at + middle.size());
        if (middle == "::msg::dds_::" && name.ends_with('_')) name.pop_back();
        return type.substr(0, at) + "/" + name;
    }
    return type;
}

bool Bag::recognises(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) {
        return opener_for(path) != nullptr || is_compressed_bag(path);
    }
    return fs::exists(path / "metadata.yaml", ignored) || !bags_in(path).empty();
}

Bag::Bag(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        paths_ = bags_in(path);
        if (paths_.empty()) {
            throw InputError(path, "", "holds no bag; looked for *.mcap, *.db3 and *.bag");
        }
        refuse_mixture(paths_, path);
    } else {
        paths_ = {path};
        refuse_mixture(paths_, path);
    }
    for (const fs::path& file : paths_) {
        if (read_head(file, 1).empty()) {
            throw InputError(file, "", "is empty; expected a bag; was it copied as a whole?");
        }
        const Open by_name = opener_for(file), by_content = opener_by_content(file);
        if (by_name == nullptr && by_content == nullptr) {
            throw InputError(file, "", "is no bag: neither its name nor its first bytes say so");
        }
        files_.push_back((by_content != nullptr ? by_content : by_name)(file));
    }
}

Bag::Bag(Bag&&) noexcept = default;
Bag::~Bag() = default;

std::vector<Defect> Bag::for_each(const std::function<void(const Message&)>& use) const {
    std::vector<Defect> defects;
    for (std::size_t f = 0; f < files_.size(); ++f) {
        auto found = files_[f]->for_each([&](const FoundMessage& m) {
            use({m.topic, m.recorded_ns, {f, m.chunk, m.offset}, m.data});
        });
        for (Defect& defect : found) {
            defects.push_back({paths_[f].string() + ": " + defect.what, defect.lost});
        }
    }
    return defects;
}

std::vector<std::byte> Bag::read(const MessageRef& message) const {
    return files_.at(message.file)->read(message.chunk, message.offset);
}

}  // namespace dynamic_filter::io
