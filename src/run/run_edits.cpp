// SPDX-License-Identifier: MIT
#include "run/run_edits.hpp"

#include <fmt/format.h>

#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "run/apply_edits.hpp"

namespace dynamic_filter::app {

std::optional<Edits> edits_for(const std::filesystem::path& output, const RunOptions& options,
                               const Config& config) {
    const std::filesystem::path own = output / kEditsFile;
    const bool has_own = std::filesystem::exists(own);
    if (!options.edits && !has_own) return std::nullopt;
    const Edits edits = read_edits(options.edits.value_or(own));
    if (options.edits && has_own && text_of(edits) != text_of(read_edits(own))) {
        throw ConfigError(own.string() +
                          ": the output folder has edits of its own; leave --edits out, or move "
                          "that file away");
    }
    if (!options.maps) {
        throw ConfigError("edits change the maps, too; leave --no-maps out, or move " +
                          options.edits.value_or(own).string() + " away");
    }
    if (config.map.time == MapTime::latest) {
        throw ConfigError(
            "edits cannot be applied to maps of map.time=latest; use --set "
            "map.time=always, or move " +
            options.edits.value_or(own).string() + " away");
    }
    return edits;
}

void apply_to_run(const std::filesystem::path& folder, const Edits& edits, bool quiet) {
    io::write_file(folder / kEditsFile, text_of(edits));
    const Applied applied = apply_edits(folder, edits, true);
    if (quiet) return;
    say("edits    {} applied: the label of {} of {} points is not the filter's\n",
        edits.edits.size(), applied.changed, applied.points);
}

}  // namespace dynamic_filter::app
