// SPDX-License-Identifier: MIT
#include "run/keep.hpp"

#include <string>

#include "run/evidence_file.hpp"
#include "run/part_file.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// The files of a folder that are there, by links.
void link_files(const fs::path& from, const fs::path& to) {
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from)) {
        const bool is_hidden = entry.path().filename().string().starts_with(".");
        if (entry.is_regular_file() && !is_hidden)
            link_or_copy(entry.path(), to / entry.path().filename());
    }
}

/// The map of a result: of several drives, or of one that was filtered in memory.
void link_map(const fs::path& from, const fs::path& to) {
    if (fs::exists(from / kMapFolder)) {
        link_files(from / kMapFolder, to / kMapFolder);
        return;
    }
    fs::create_directories(to);
    const char* const file = "static_map.pcd";
    if (fs::exists(from / file)) link_or_copy(from / file, to / file);
}

}  // namespace

void keep_evidence(const Job& job, const fs::path& tiles, const RunOptions& o,
                   const OutputFolder& output) {
    const fs::path folder = output.subfolder(kEvidenceFolder);
    for (const TileWork& work : job.plan.tiles) {
        const std::string file = evidence_file(work.tile);
        link_or_copy(tiles / file, folder / file);
    }
    link_or_copy(tiles / kPlanFile, folder / kPlanFile);
    std::vector<DriveSource> sources = job.sources;
    for (std::size_t d = 0; d < job.first_new(); ++d) {
        if (!sources[d].poses) continue;
        // The poses that a run refined are in its output, which may go.
        const std::string file = job.drives[d].name + ".txt";
        link_or_copy(*sources[d].poses, folder / file);
        sources[d].poses = output.name() / kEvidenceFolder / file;
    }
    write_part(folder, {.number = {}, .sources = sources, .run = o});
}

void keep_history(const fs::path& earlier, const OutputFolder& output) {
    const fs::path folder = output.subfolder(kHistoryFolder);
    std::size_t last = 0;
    while (fs::exists(earlier / kHistoryFolder / std::to_string(last + 1))) {
        ++last;
        link_map(earlier / kHistoryFolder / std::to_string(last), folder / std::to_string(last));
    }
    link_map(earlier, folder / std::to_string(last + 1));
}

}  // namespace dynamic_filter::app
