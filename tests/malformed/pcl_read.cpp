// SPDX-License-Identifier: MIT
// pcl_read FILE OUT.bin: what PCL finds in a .pcd or .ply, as float32 x y z 0. Exit 3: it said that
// it failed. Built by script/malformed.
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <cstdio>
#include <fstream>
#include <string>

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const std::string file = argv[1];
    pcl::PointCloud<pcl::PointXYZ> cloud;
    const bool is_ply = file.substr(file.size() - 4) == ".ply";
    try {
        if ((is_ply ? pcl::io::loadPLYFile(file, cloud) : pcl::io::loadPCDFile(file, cloud)) < 0) {
            return 3;
        }
    } catch (const pcl::PCLException& error) {  // what its documentation names; no other
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
    std::ofstream out(argv[2], std::ios::binary);
    for (const pcl::PointXYZ& point : cloud) {
        const float record[] = {point.x, point.y, point.z, 0.0F};
        out.write(reinterpret_cast<const char*>(record), sizeof record);
    }
    return 0;
}
