// SPDX-License-Identifier: MIT
#include "arena/truth_cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "arena/score_trial.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/scores.hpp"
#include "geometry/neighbor_grid.hpp"
#include "recording/folders.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// The points of the folder's scans before those of the trial, in them, and of all scans.
struct PointCounts {
    std::size_t before = 0, chosen = 0, all = 0;
};

PointCounts points_in_scans(const Trial& trial, const io::Recording& recording) {
    const auto& chosen = recording.info().scan_files;
    PointCounts counts;
    bool has_begun = false;
    for (const fs::path& file : io::list_files(trial.data.data / "pcd", {".pcd"})) {
        const std::size_t points = io::read_cloud(file).size();
        const bool is_chosen = std::find(chosen.begin(), chosen.end(), file) != chosen.end();
        has_begun = has_begun || is_chosen;
        if (is_chosen) counts.chosen += points;
        if (!has_begun) counts.before += points;
        counts.all += points;
    }
    return counts;
}

}  // namespace

void put_point(io::Cloud& cloud, const Point& p, float intensity) {
    const std::array record{p.x(), p.y(), p.z(), intensity};
    const auto bytes = std::as_bytes(std::span(record));
    cloud.data.insert(cloud.data.end(), bytes.begin(), bytes.end());
}

io::Cloud truth_cloud(const Trial& trial, const io::Recording& recording) {
    const fs::path file = trial.data.data / "gt_cloud.pcd";
    io::Cloud truth = io::read_cloud(file);
    if (!truth.find("intensity")) {
        throw InputError(file, "", "has no intensity, which is 1 where something moves");
    }
    const auto files = io::list_files(trial.data.data / "pcd", {".pcd"});
    if (files.size() == recording.size()) return truth;
    const PointCounts counts = points_in_scans(trial, recording);
    if (truth.size() == counts.chosen) return truth;
    if (truth.size() != counts.all) {
        throw InputError(
            file, "",
            fmt::format("has {} points, but the {} scans of the arena have {}, and all "
                        "scans of the folder have {}; so it is of other scans",
                        truth.size(), recording.size(), counts.chosen, counts.all));
    }
    const auto at = [&](std::size_t points) {
        return truth.data.begin() + static_cast<std::ptrdiff_t>(points * truth.point_bytes);
    };
    truth.data = {at(counts.before), at(counts.before + counts.chosen)};
    return truth;
}

io::Cloud clean_cloud(const io::Recording& recording, const fs::path& labels) {
    io::Cloud map;
    for (const char* name : {"x", "y", "z", "intensity"}) {
        io::add_field(map, name, io::FieldType::f32);
    }
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const Points world = io::positions(recording.read(i).cloud);
        const Labels found = verdict_of(labels, recording, i, world.size());
        for (std::size_t p = 0; p < world.size(); ++p) {
            if (found[p] != Label::dynamic && world[p].allFinite()) put_point(map, world[p], 0.0F);
        }
    }
    if (map.size() == 0) throw InputError(labels, "", "label no point static");
    return map;
}

std::vector<char> near_map(const Points& truth, const Points& map) {
    constexpr auto kNear = static_cast<float>(eval::kCoverDistance);
    const NeighborGrid grid(map, 2.0F * kNear);
    std::vector<char> is_near(truth.size());
    parallel_for(truth.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            is_near[p] = grid.any_within(truth[p], kNear) ? 1 : 0;
        }
    });
    return is_near;
}

ArenaScores by_truth_cloud(const Trial& trial, const io::Recording& recording,
                           const Estimate& estimate) {
    const io::Cloud truth = truth_cloud(trial, recording);
    const std::vector<double> moves = io::values(truth, *truth.find("intensity"));
    const std::vector<char> is_kept =
        near_map(io::positions(truth), estimate.labels
                                           ? io::positions(clean_cloud(recording, *estimate.labels))
                                           : map_of(estimate, Eigen::Vector3d::Zero()));
    eval::CoverCount count;
    for (std::size_t p = 0; p < moves.size(); ++p) {
        count.add(moves[p] == 1.0 ? Label::dynamic : Label::static_, is_kept[p] != 0);
    }
    return accuracies(eval::point_score(count));
}

}  // namespace dynamic_filter::app
