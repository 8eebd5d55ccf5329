// SPDX-License-Identifier: MIT
#include "run/city.hpp"

#include <fmt/format.h>

#include "dynamic_filter/error.hpp"
#include "run/run_state.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

void refuse_what_tiles_cannot(const RunOptions& o, const Config& config) {
    const auto refuse = [](const std::string& what, const std::string& instead) {
        throw ConfigError(what + " does not go with several recordings, --part, --memory or --mpi" +
                          instead);
    };
    if (o.online) refuse("--online", "");
    if (o.view) refuse("--view", "");
    if (o.edits) refuse("--edits", "");
    if (o.refine == "on" || config.odometry.refine) {
        refuse("refining poses", "; refine those of each drive first, in a run of its own");
    }
    if (config.method != Method::scans) refuse("--preset paper", "; use the default preset");
}

/// What the run was begun with, whatever part of it a process does.
std::string begun_with(const std::vector<Drive>& drives, const Config& config,
                       std::size_t tile_voxels) {
    std::string state =
        fmt::format("version {}\ntiles of {} voxels\n", DYNAMIC_FILTER_VERSION, tile_voxels);
    for (const Drive& drive : drives) state += state_of(drive.sequence);
    return state + to_toml(config);
}

}  // namespace

City open_city(const std::vector<DriveSource>& sources, const RunOptions& o) {
    const Config config = load_config(o.config);
    refuse_what_tiles_cannot(o, config);
    City city{.config = config, .drives = open_drives(sources, o.data), .plan = {}, .run = {}};
    city.run = begun_with(city.drives, config, o.city.tile_voxels);
    return city;
}

std::string state_of_output(const City& city, const RunOptions& o) {
    return city.run + (o.maps ? "" : "no maps\n") + (o.report ? "" : "no report\n") +
           (o.city.part.empty() ? "" : "part " + o.city.part + "\n");
}

void tell_notes(const City& city, bool quiet) {
    for (const std::string& warning : city.plan.warnings) {
        fmt::print(stderr, "warning: {}\n", warning);
    }
    for (std::size_t d = 0; d < city.drives.size(); ++d) {
        const std::string& name = city.drives[d].name;
        const PlannedDrive& planned = city.plan.drives[d];
        for (const std::string& note : planned.notes) {
            if (!quiet) fmt::print(stderr, "note: {}: {}\n", name, note);
        }
        for (const std::string& warning : planned.warnings) {
            fmt::print(stderr, "warning: {}: {}\n", name, warning);
        }
    }
}

}  // namespace dynamic_filter::app
