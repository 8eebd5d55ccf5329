// SPDX-License-Identifier: MIT
#include "export/outputs.hpp"

#include <algorithm>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

const std::vector<Output>& outputs() {
    static const std::vector<Output> rows = {
        {.name = "kitti", .files = &recording_files(), .of_recording = make_kitti_sink},
        {.name = "benchmark", .files = &benchmark_files(), .of_recording = make_benchmark_sink},
        {.name = "nav2",
         .files = &nav2_files(),
         .of_recording = make_nav2_sink,
         .from_sensor = true,
         .is_of_drives = true},
        {.name = "objects",
         .files = &object_files(),
         .of_recording = make_objects_sink,
         .of_whole_scans = true},
        {.name = "3dtiles", .files = &tileset_files(), .of_map = tileset_of_map},
        {.name = "las", .files = &las_files(), .of_map = las_of_map},
        {.name = "autoware",
         .files = &autoware_files(),
         .of_map = autoware_of_map,
         .of_cloud = autoware_of_cloud},
        {.name = "OctoMap",
         .of_recording = make_octomap_sink,
         .from_sensor = true,
         .is_of_drives = true,
         .extensions = {".bt", ".ot"}}};
    return rows;
}

std::vector<std::string> output_names() {
    std::vector<std::string> names;
    for (const Output& output : outputs()) {
        if (output.extensions.empty()) names.push_back(output.name);
    }
    return names;
}

const Output* chosen_output(const ConvertOptions& o) {
    const auto ends_in = [&](const std::string& ending) { return o.output.extension() == ending; };
    for (const Output& output : outputs()) {
        if (std::none_of(output.extensions.begin(), output.extensions.end(), ends_in)) continue;
        if (o.to.empty()) return &output;
        throw ConfigError(o.output.string() + ": is named as a file of " + output.name +
                          ", but --to " + o.to + " makes a folder");
    }
    if (o.to.empty()) return nullptr;
    for (const Output& output : outputs()) {
        if (output.extensions.empty() && output.name == o.to) return &output;
    }
    throw ConfigError("--to " + o.to + ": there is no such output");
}

std::string outputs_of_maps() {
    std::vector<std::string> names;
    for (const Output& output : outputs()) {
        if (output.extensions.empty() && (output.of_map != nullptr || output.is_of_drives))
            names.push_back("--to " + output.name);
    }
    std::string text = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) {
        text += (i + 1 < names.size() ? ", " : " or ") + names[i];
    }
    return text;
}

std::unique_ptr<Sink> make_sink(const ConvertOptions& o) {
    if (const Output* const chosen = chosen_output(o)) return chosen->of_recording(o);
    if (o.output.extension().empty()) return make_kitti_sink(o);
    return io::BagWriter::recognises(o.output) ? make_bag_sink(o) : make_cloud_sink(o);
}

}  // namespace dynamic_filter::app
