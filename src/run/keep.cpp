// SPDX-License-Identifier: MIT
#include "run/keep.hpp"

#include <string>

#include "run/evidence_file.hpp"
#include "run/part_file.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

constexpr const char* kMapFile = "static_map.pcd";

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
    if (fs::exists(from / kMapFile)) link_or_copy(from / kMapFile, to / kMapFile);
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
    const std::vector<DriveSource> sources = with_pose_files(job.sources, o.data);
    for (std::size_t d = 0; d < sources.size(); ++d) {
        if (!sources[d].poses) continue;
        fs::copy_file(*sources[d].poses, folder / evidence_poses_file(d),
                      fs::copy_options::overwrite_existing);
    }
    RunOptions run = o;
    run.data.poses.reset();  // each recording has its own
    write_part(folder, {.number = {}, .sources = sources, .run = run});
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
