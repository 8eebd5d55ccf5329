// SPDX-License-Identifier: MIT
/// Writes a cloud in every format into a folder, for read_back.py.
#include <filesystem>
#include <span>

#include "dynamic_filter/writers.hpp"

namespace {

using namespace dynamic_filter::io;

template <class T>
void append(Cloud& cloud, T value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    cloud.data.insert(cloud.data.end(), bytes.begin(), bytes.end());
}

Cloud sample() {
    Cloud cloud;
    for (const char* name : {"x", "y", "z", "intensity"}) add_field(cloud, name, FieldType::f32);
    add_field(cloud, "dynamic", FieldType::u8);
    for (int i = 0; i < 5; ++i) {
        const auto n = static_cast<float>(i);
        for (const float value : {n, -0.5F * n, 100.0F + n, 0.25F * n}) append(cloud, value);
        append(cloud, static_cast<std::uint8_t>(i % 2));
    }
    return cloud;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return 2;
    const std::filesystem::path folder = arguments[1];
    write_pcd(folder / "ascii.pcd", sample(), PcdData::ascii);
    write_pcd(folder / "compressed.pcd", sample(), PcdData::compressed);
    for (const char* name : {"a.pcd", "a.ply", "a.las", "a.npy"}) {
        write_cloud(folder / name, sample());
    }
    return 0;
}
