// SPDX-License-Identifier: MIT
/// Edits into the labels and maps of a run.
#pragma once

#include <cstddef>
#include <filesystem>

#include "run/edits.hpp"

namespace dynamic_filter::app {

struct Applied {
    std::size_t points = 0, changed = 0;  ///< changed: their label is not the filter's
};

/// Throws InputError or ConfigError, with what to do, where edits cannot be applied to the run in
/// the folder: no run, without maps, with map.time = latest.
void refuse_unless_editable(const std::filesystem::path& run);

/// The filter's labels and maps are kept in `RUN/unedited`, made at the first call, and are what
/// every call starts from. Each file is replaced as a whole; a call that was killed is finished by
/// the next one. `afresh`: the filter has just written labels and maps, which are to be kept.
/// Single caller; holds the maps in memory. Throws InputError and OutputError.
Applied apply_edits(const std::filesystem::path& run, const Edits& edits, bool afresh);

/// Whether labels and maps are those of `edits`.
bool is_applied(const std::filesystem::path& run, const Edits& edits);

}  // namespace dynamic_filter::app
