// SPDX-License-Identifier: MIT
/// The outputs of `convert`. A new one that --to names is a file, and a row of outputs.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "export/convert_options.hpp"
#include "export/sink.hpp"
#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

/// What became of a map: files, and a sentence on what is not as one might expect.
struct WrittenMap {
    std::size_t files = 0;
    std::string note{};
};

/// A folder that --to names, or a file by its extension. A function is nullptr if the output cannot
/// be made of that.
struct Output {
    std::string name;                    ///< "3dtiles"
    const FolderFiles* files = nullptr;  ///< of a folder
    std::unique_ptr<Sink> (*of_recording)(const ConvertOptions& options) = nullptr;
    /// `map`: the folder of the index.
    WrittenMap (*of_map)(const MapIndex& index, const std::filesystem::path& map,
                         const ConvertOptions& options,
                         const std::filesystem::path& output) = nullptr;
    WrittenMap (*of_cloud)(const io::Cloud& cloud, const ConvertOptions& options,
                           const std::filesystem::path& output) = nullptr;
    /// True: scans are in the sensor's frame, where beams begin; else in the frame of the files.
    bool from_sensor = false;
    /// True: it writes something for each point of the recording, so no part of it will do.
    bool of_whole_scans = false;
    /// True: it can be made of all drives of a map.
    bool is_of_drives = false;
    std::vector<std::string> extensions{};  ///< of a file, such as ".bt"; --to does not name it

    /// As messages name it: "--to 3dtiles".
    [[nodiscard]] std::string shown() const { return extensions.empty() ? "--to " + name : name; }
};

/// All rows, in the order in which messages name them.
const std::vector<Output>& outputs();
std::vector<std::string> output_names();
/// The output that --to or the extension names; nullptr for bags, clouds and the usual folder.
/// Throws ConfigError if there is none of that name.
const Output* chosen_output(const ConvertOptions& options);
/// "--to 3dtiles, --to las or --to autoware": what can be made of a map.
std::string outputs_of_maps();

/// Chooses the sink of a recording by --to and the output's name. Throws ConfigError before any
/// work is done.
std::unique_ptr<Sink> make_sink(const ConvertOptions& options);
/// Throws ConfigError if the output is no cloud file that can be written, or is there already.
void check_cloud_output(const ConvertOptions& options);

/// The files of a recording in SemanticKITTI's layout.
const FolderFiles& recording_files();
const FolderFiles& benchmark_files();

std::unique_ptr<Sink> make_kitti_sink(const ConvertOptions& options);
std::unique_ptr<Sink> make_benchmark_sink(const ConvertOptions& options);
std::unique_ptr<Sink> make_bag_sink(const ConvertOptions& options);
/// All points in one cloud.
std::unique_ptr<Sink> make_cloud_sink(const ConvertOptions& options);

/// A map in two dimensions for nav2 and ROS 1's map_server.
const FolderFiles& nav2_files();
std::unique_ptr<Sink> make_nav2_sink(const ConvertOptions& options);

/// What moves: objects with numbers, boxes and pictures.
const FolderFiles& object_files();
std::unique_ptr<Sink> make_objects_sink(const ConvertOptions& options);

/// Known-free and occupied voxels for OctoMap.
std::unique_ptr<Sink> make_octomap_sink(const ConvertOptions& options);

const FolderFiles& tileset_files();
const FolderFiles& las_files();
const FolderFiles& autoware_files();
WrittenMap tileset_of_map(const MapIndex& index, const std::filesystem::path& map,
                          const ConvertOptions& options, const std::filesystem::path& output);
WrittenMap las_of_map(const MapIndex& index, const std::filesystem::path& map,
                      const ConvertOptions& options, const std::filesystem::path& output);
WrittenMap autoware_of_map(const MapIndex& index, const std::filesystem::path& map,
                           const ConvertOptions& options, const std::filesystem::path& output);
WrittenMap autoware_of_cloud(const io::Cloud& cloud, const ConvertOptions& options,
                             const std::filesystem::path& output);

}  // namespace dynamic_filter::app
