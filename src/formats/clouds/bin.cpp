// SPDX-License-Identifier: MIT
#include "base/input.hpp"
#include "base/text.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/cloud_size.hpp"

namespace dynamic_filter::io {
namespace {

/// Likely reason for the size of a .bin file that is not a multiple of 16.
std::string explain_bin_size(std::size_t bytes) {
    if (bytes % 20 == 0) return "it looks like 5 floats a point (nuScenes); name it .pcd.bin";
    if (bytes % 12 == 0) return "it looks like 3 floats a point (x y z); add an intensity";
    return "it is truncated after point " + std::to_string(bytes / 16);
}

Cloud empty_bin(const std::filesystem::path& file) {
    // NuScenes files end in .pcd.bin.
    const bool has_ring = to_lower(file.stem().extension().string()) == ".pcd";
    Cloud cloud;
    for (const char* name : {"x", "y", "z", "intensity"}) add_field(cloud, name, FieldType::f32);
    if (has_ring) add_field(cloud, "ring", FieldType::f32);
    return cloud;
}

}  // namespace

void refuse_bad_bin_size(const std::filesystem::path& file, std::size_t bytes) {
    const std::size_t stride = empty_bin(file).point_bytes;
    if (bytes == 0) {
        throw InputError(file, "byte 0",
                         "is empty; expected " + std::to_string(stride) + " bytes a point");
    }
    if (bytes % stride == 0) return;
    throw InputError(
        file, "byte " + std::to_string(bytes - bytes % stride),
        "its size of " + std::to_string(bytes) + " bytes is no multiple of " +
            std::to_string(stride) + " (float32 x y z intensity" +
            (stride > 16 ? " ring); it is truncated" : "); " + explain_bin_size(bytes)));
}

Cloud read_bin(const std::filesystem::path& file) {
    Cloud cloud = empty_bin(file);
    cloud.data = read_bytes(file);
    refuse_bad_bin_size(file, cloud.data.size());
    return cloud;
}

}  // namespace dynamic_filter::io
