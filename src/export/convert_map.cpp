// SPDX-License-Identifier: MIT
#include "export/convert_map.hpp"

#include <fmt/format.h>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "export/outputs.hpp"
#include "formats/voxel_map/map_index.hpp"

namespace dynamic_filter::app {

namespace {

const Output& checked_output(const ConvertOptions& o) {
    const Output* const output = chosen_output(o);
    if (output == nullptr || output->of_map == nullptr) {
        throw ConfigError(o.data.data.string() +
                          ": is the map of several drives; choose what to make of it with " +
                          outputs_of_maps() + ", or name OUT as a cloud or an OctoMap");
    }
    if (o.labels) {
        throw ConfigError(
            "--labels is for a recording; the map of several drives holds static voxels only");
    }
    if (!o.box.empty() || o.max_range > 0.0 || !o.only.empty() || o.thin > 0.0) {
        throw ConfigError(
            "--box, --max-range, --only and --thin are for a recording or a cloud, not for the map "
            "of several drives");
    }
    if (!o.crs.empty() && o.to != "las")
        throw ConfigError("--crs: --to las alone has a place for it");
    if (!o.origin.empty() && o.crs.empty() && o.to == "las") {
        throw ConfigError("--origin: --to las needs --crs, too");
    }
    return *output;
}

}  // namespace

int convert_map(const ConvertOptions& o) {
    const Output& kind = checked_output(o);
    const std::filesystem::path map = map_folder_of(o.data.data);
    const MapIndex index = read_map_index(map);
    OutputFolder output(o.output, *kind.files, replaced_if(o.overwrite));
    const WrittenMap written = kind.of_map(index, map, o, output.path());
    output.commit();
    if (!written.note.empty()) say(stderr, "note: {}\n", written.note);
    if (!o.quiet)
        say("written  {} ({} tiles as {} files)\n", output.name().string(), index.tiles.size(),
            written.files);
    return kDone;
}

}  // namespace dynamic_filter::app
