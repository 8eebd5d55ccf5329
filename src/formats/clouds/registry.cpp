// SPDX-License-Identifier: MIT
#include "formats/clouds/registry.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "formats/clouds/cloud_size.hpp"

namespace dynamic_filter::io {
namespace {

/// For formats that store every point.
template <std::string (*write)(const std::filesystem::path&, const Cloud&)>
Written write_all(const std::filesystem::path& path, const Cloud& cloud) {
    return {cloud.size(), write(path, cloud)};
}

std::string write_binary_pcd(const std::filesystem::path& path, const Cloud& cloud) {
    write_pcd(path, cloud);
    return "";
}

}  // namespace

const std::vector<CloudFormat>& cloud_formats() {
    static const std::vector<CloudFormat> formats = {
        {".pcd", read_pcd, write_all<write_binary_pcd>, true},
        {".ply", read_ply, write_all<write_ply>, true},
        {".las", read_las, write_las, true},
        {".laz", read_las, nullptr, false, nullptr, false},
        {".npy", read_npy, write_all<write_npy>, true},
        {".bin", read_bin, write_all<write_bin>, true, refuse_bad_bin_size},
        {".xyz", read_text_cloud, write_all<write_text_cloud>, false},
        {".txt", read_text_cloud, write_all<write_text_cloud>, false},
        {".csv", read_text_cloud, write_all<write_text_cloud>, false}};
    return formats;
}

const CloudFormat* cloud_format_of(const std::filesystem::path& file) {
    const std::string extension = to_lower(file.extension().string());
    const auto& formats = cloud_formats();
    const auto found = std::find_if(formats.begin(), formats.end(), [&](const CloudFormat& format) {
        return format.extension == extension;
    });
    return found == formats.end() ? nullptr : &*found;
}

std::string cloud_extensions(Purpose purpose) {
    std::string extensions;
    for (const CloudFormat& format : cloud_formats()) {
        if (purpose == Purpose::write ? format.write == nullptr : !format.is_named) continue;
        extensions += (extensions.empty() ? "" : ", ") + format.extension;
    }
    return extensions;
}

const std::set<std::string>& scan_extensions() {
    static const std::set<std::string> extensions = [] {
        std::set<std::string> found;
        for (const CloudFormat& format : cloud_formats()) {
            if (format.is_scan) found.insert(format.extension);
        }
        return found;
    }();
    return extensions;
}

}  // namespace dynamic_filter::io
