// SPDX-License-Identifier: MIT
// Writes a cloud in the format that the file's name asks for, and prints what is in it, from what
// went in: a line per field, as the readers of others beside this file print them.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "dynamic_filter/writers.hpp"
#include "peers/sample.hpp"

namespace dynamic_filter::io {
namespace {

/// As write_cloud, but for the kinds of PCD: a.ascii.pcd, a.compressed.pcd.
void write(const std::filesystem::path& path, const Cloud& cloud) {
    const auto kind = path.stem().extension();
    if (kind == ".ascii") return write_pcd(path, cloud, PcdData::ascii);
    if (kind == ".compressed") return write_pcd(path, cloud, PcdData::compressed);
    write_cloud(path, cloud);
}

void print(const std::filesystem::path& path, const Cloud& cloud) {
    for (const char* name : {"x", "y", "z", "intensity", "dynamic"}) {
        std::vector<double> column = values(cloud, *cloud.find(name));
        if (path.extension() == ".las" && name[1] == '\0') {  // coordinates to 1 mm
            for (double& value : column) value = std::round(1000.0 * value);
        }
        if (path.extension() == ".bin" && name[0] == 'd') continue;  // four floats, no more
        fmt::print("{} {} {:08x}\n", name, column.size(), fnv1a(column));
    }
}

}  // namespace
}  // namespace dynamic_filter::io

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    using namespace dynamic_filter;
    test::Random random(12);
    io::Cloud cloud = io::sample_fields(io::FieldType::f32);
    add_field(cloud, "dynamic", io::FieldType::u8);
    fill(cloud, 1000, random);
    io::write(argv[1], cloud);
    io::print(argv[1], cloud);
    return 0;
}
