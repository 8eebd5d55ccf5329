// SPDX-License-Identifier: MIT
#include "recording/layouts/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {

const std::vector<LayoutRow>& layout_rows() {
    static const std::vector<LayoutRow> rows = {
        {{"bag", "a bag of ROS 1 or ROS 2", "*.mcap, *.bag, *.db3, or a folder with such files"},
         Turn::bag,
         nullptr},
        {{"rig", "several sensors on one vehicle",
          "a file RIG.toml that names the recording and the place of each sensor"},
         Turn::rig,
         nullptr},
        {{"nuscenes", "a scene of nuScenes", "v1.0-*/sample_data.json; a scene is DATA/SCENE"},
         Turn::path,
         find_nuscenes},
        {{"kitti-360", "a drive of KITTI-360", "data_3d_raw/DRIVE/velodyne_points/data/*.bin"},
         Turn::contents,
         find_kitti_360},
        {{"kitti-raw", "a raw drive of KITTI", "velodyne_points/data/*.bin"},
         Turn::contents,
         find_kitti_raw},
        {{"apollo", "a sample of Apollo",
          "pcds/*.pcd with nine columns in poses.txt or poses/gt_poses.txt"},
         Turn::contents,
         find_apollo},
        {{"mulran", "a recording of MulRan",
          "Ouster/*.bin or sensor_data/Ouster/*.bin with global_pose.csv"},
         Turn::contents,
         find_mulran},
        {{"pairs", "scans of interactive_slam", "*.pcd with *.odom beside them"},
         Turn::contents,
         find_pairs},
        {{"glim", "a dump of GLIM", "NNNNNN/data.txt with NNNNNN/points_compact.bin"},
         Turn::contents,
         find_glim},
        {{"hdl", "a dump of hdl_graph_slam", "NNNNNN/cloud.pcd with NNNNNN/data"},
         Turn::contents,
         find_hdl},
        {{"kitti", "KITTI's odometry data, or SemanticKITTI", "velodyne/*.bin"},
         Turn::usual,
         find_kitti},
        {{"benchmark", "DynamicMap_Benchmark", "pcd/*.pcd"}, Turn::usual, find_benchmark},
        {{"folder", "any folder of scans", "scans, here or in a usual subfolder"},
         Turn::usual,
         find_folder}};
    return rows;
}

std::optional<Layout> ask(const LayoutRow& row, const Place& place) {
    std::optional<Layout> layout = row.find(place);
    if (layout) layout->name = row.name.name;
    return layout;
}

std::optional<Layout> find_in_turn(Turn turn, const Place& place) {
    for (const LayoutRow& row : layout_rows()) {
        if (row.turn != turn) continue;
        if (auto layout = ask(row, place)) return layout;
    }
    return std::nullopt;
}

std::vector<std::string> layout_names() {
    std::vector<std::string> names;
    for (const LayoutRow& row : layout_rows()) names.push_back(row.name.name);
    return names;
}

const LayoutRow& layout_row(const std::string& name) {
    for (const LayoutRow& row : layout_rows()) {
        if (row.name.name == name) return row;
    }
    throw ConfigError(fmt::format("unknown format '{}'; choose one of {}", name,
                                  fmt::join(layout_names(), ", ")));
}

InputError not_of_layout(const std::filesystem::path& data, const LayoutRow& row) {
    return {data, "",
            fmt::format("is not {} (--format {}); looked for {}", row.name.what, row.name.name,
                        row.name.files)};
}

std::vector<LayoutName> layouts() {
    std::vector<LayoutName> names;
    for (const LayoutRow& row : layout_rows()) names.push_back(row.name);
    return names;
}

}  // namespace dynamic_filter::io
