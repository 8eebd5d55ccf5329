// SPDX-License-Identifier: MIT
#include "run/part_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "run/data_json.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json json_of(const std::vector<DriveSource>& sources) {
    Json json = Json::array();
    for (const DriveSource& source : sources) {
        Json one{{"recording", full_path(source.recording)}};
        if (source.poses) one["poses"] = full_path(*source.poses);
        json.push_back(one);
    }
    return json;
}

}  // namespace

PartNumber part_number_of(const std::string& text) {
    PartNumber number{.part = 0, .parts = 0};
    const char* const end = text.data() + text.size();
    const auto [slash, error] = std::from_chars(text.data(), end, number.part);
    const bool has_slash = error == std::errc{} && slash != end && *slash == '/';
    const auto last = has_slash ? std::from_chars(slash + 1, end, number.parts)
                                : std::from_chars_result{text.data(), std::errc::invalid_argument};
    const bool fine = last.ec == std::errc{} && last.ptr == end && number.part >= 1 &&
                      number.part <= number.parts;
    if (fine) return number;
    throw ConfigError(
        "--part " + text +
        ": expected I/N with I from 1 to N, for instance 2/8 for the second of eight");
}

void write_part(const fs::path& folder, const Part& part) {
    const RunOptions& run = part.run;
    const Json json{{"version", 1},
                    {"part", part.number.part},
                    {"parts", part.number.parts},
                    {"drives", json_of(part.sources)},
                    {"reading", json_of(run.data)},
                    {"tile_voxels", run.tile_voxels},
                    {"maps", run.maps},
                    {"report", run.report}};
    io::write_file(folder / kPartFile, json.dump(2) + "\n");
}

Part read_part(const fs::path& folder) {
    const fs::path file = folder / kPartFile;
    if (!fs::exists(file)) {
        throw InputError(folder, "",
                         "holds no part of a run (no part.json); expected the -o folder of "
                         "`dynamicfilter run ... --part I/N`");
    }
    try {
        const Json json = Json::parse(io::read_file(file));
        if (json.at("version") != 1) {
            throw InputError(file, "version", "is of another version of dynamicfilter");
        }
        Part part{.number = {.part = json.at("part"), .parts = json.at("parts")},
                  .sources = {},
                  .run = {}};
        for (const Json& drive : json.at("drives")) {
            DriveSource source{.recording = drive.at("recording").get<std::string>()};
            if (drive.contains("poses")) source.poses = drive["poses"].get<std::string>();
            part.sources.push_back(std::move(source));
        }
        part.run.data = data_options_of(json.at("reading"));
        part.run.tile_voxels = json.at("tile_voxels");
        part.run.maps = json.at("maps");
        part.run.report = json.at("report");
        part.run.config.file = folder / "config.toml";
        return part;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(file, "",
                         std::string("is damaged; make its folder again (") + error.what() + ")");
    }
}

}  // namespace dynamic_filter::app
