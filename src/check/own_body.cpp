// SPDX-License-Identifier: MIT
#include "check/own_body.hpp"

#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "check/scan_input.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/range_image.hpp"
#include "geometry/beam_image.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter::io {
namespace {

constexpr float kBodyCell = 0.2F;                   // [m]
constexpr float kBodyReach = 10.0F;                 // [m] from the sensor
constexpr double kNearPair = 2.5, kFarPair = 12.0;  // [m] between the scans of a pair
constexpr std::size_t kPairs = 12, kFewestPairs = 4;

/// Two scans from which the same surroundings are seen.
using BodyPair = std::pair<std::size_t, std::size_t>;

/// Pairs of scans some metres apart, from all over the recording. None if the way is too short.
std::vector<BodyPair> pairs_apart(const Recording& recording) {
    const auto& poses = recording.info().T_world_sensor;
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (poses[i].matrix().allFinite()) known.push_back(i);
    }
    std::vector<BodyPair> pairs;
    std::size_t one_after_another = 0, after = 0;
    std::size_t j = 0;
    for (const std::size_t i : known) {
        const auto way = [&] {
            return (poses[known[j]].translation() - poses[i].translation()).norm();
        };
        while (j < known.size() && (known[j] <= i || way() < kNearPair)) ++j;
        if (j == known.size()) break;
        if (way() >= kFarPair) continue;
        pairs.emplace_back(i, known[j]);
        if (i < after) continue;
        ++one_after_another;
        after = known[j];
    }
    if (one_after_another < kFewestPairs) return {};
    std::vector<BodyPair> chosen;
    const std::size_t count = std::min(pairs.size(), kPairs);
    for (std::size_t k = 0; k < count; ++k) chosen.push_back(pairs[k * pairs.size() / count]);
    return chosen;
}

struct BodyScan {
    Points near;  // sensor frame, within reach
    std::size_t measured = 0;
    BeamImage image;
    Pose T_world_sensor = Pose::Identity();
};

/// Of the first scan that can be read, because the sensor does not change.
BeamPattern beams_of(const Recording& recording, const std::vector<BodyPair>& pairs) {
    for (const auto& [a, b] : pairs) {
        if (const auto scan = read_scan(recording, a)) return estimate_beam_pattern({&*scan, 1});
    }
    return {};
}

BodyScan body_scan_of(const FullScan& full, const BeamPattern& beams) {
    BodyScan scan;
    for (const Point& p : full.points) {
        if (!is_measured(p)) continue;
        ++scan.measured;
        if (p.norm() < kBodyReach) scan.near.push_back(p);
    }
    scan.image = BeamImage(full.points, beams);
    scan.T_world_sensor = full.T_world_sensor;
    return scan;
}

/// How the beams around a place go on: all of them beyond it (passes), or one of them ends at it.
/// One that passes below the place must be among the first ones, because between two rings on the
/// ground only the upper beam goes on.
enum class Look : std::uint8_t { unknown, passes, hits };
Look look_at(const BeamImage& image, const Beam& place) {
    const ImageGrid& grid = image.grid();
    if (image.empty()) return Look::unknown;
    const float margin = std::max(0.5F, 0.05F * place.range);
    const int row =
        static_cast<int>(std::floor((place.elevation - grid.elevation_min) / grid.elevation_step));
    const int column = static_cast<int>((place.azimuth + 3.14159265F) / grid.azimuth_step);
    int beams = 0, beyond = 0, below = 0;
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows - 1); ++r) {
        for (int c = column - 1; c <= column + 1; ++c) {
            const int around = (c + grid.columns) % grid.columns;
            if (!image.has_beam(r, around)) continue;
            const Beam beam = image.beam(r, around);
            const float gap = beam.range - place.range;
            if (std::abs(gap) < margin) return Look::hits;
            ++beams;
            beyond += gap > 0.0F ? 1 : 0;
            below += beam.elevation < place.elevation ? 1 : 0;
        }
    }
    return below > 0 && beyond == beams ? Look::passes : Look::unknown;
}

struct BodyCell {
    std::size_t scans = 0, points = 0, passes = 0, hits = 0;
    std::size_t last = 0;  // number of the last scan with a point in it, from 1
};
using BodyCells = tsl::robin_map<VoxelKey, BodyCell, VoxelHash>;

/// What `other` says about the places of the points of `scan`, a few of each cell.
void look_from(const BodyScan& other, const BodyScan& scan, BodyCells& cells) {
    const Eigen::Isometry3f T_other_scan =
        (other.T_world_sensor.inverse() * scan.T_world_sensor).cast<float>();
    Directions seen;
    to_spherical(scan.near, T_other_scan, seen);
    for (std::size_t i = 0; i < scan.near.size(); ++i) {
        const auto it = cells.find(pack(*cell_of(scan.near[i], 1.0F / kBodyCell)));
        if (it == cells.end()) continue;
        const Look look = look_at(other.image, {seen.azimuth[i], seen.elevation[i], seen.range[i]});
        it.value().passes += look == Look::passes ? 1 : 0;
        it.value().hits += look == Look::hits ? 1 : 0;
    }
}

using Body = tsl::robin_set<VoxelKey, VoxelHash>;

/// The cells beside one that `takes` accepts, and those beside these.
template <class Takes>
void spread(std::vector<VoxelKey> front, const Takes& takes) {
    while (!front.empty()) {
        const Cell from = unpack(front.back());
        front.pop_back();
        for (int k = 0; k < 27; ++k) {
            const VoxelKey key = pack(Cell(from + Cell(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
            if (takes(key)) front.push_back(key);
        }
    }
}

std::size_t points_of(const BodyCells& cells, const Body& body) {
    std::size_t points = 0;
    for (const VoxelKey key : body) points += cells.at(key).points;
    return points;
}

/// Leaves out single cells apart from the body, such as those of a wall along the way.
Body main_parts(const BodyCells& cells, Body body) {
    constexpr double kLeastPart = 0.02;  // of the points
    const auto all = static_cast<double>(points_of(cells, body));
    Body kept;
    while (!body.empty()) {
        Body part = {*body.begin()};
        body.erase(body.begin());
        spread({*part.begin()}, [&](VoxelKey key) {
            if (body.erase(key) == 0) return false;
            part.insert(key);
            return true;
        });
        if (static_cast<double>(points_of(cells, part)) < kLeastPart * all) continue;
        kept.insert(part.begin(), part.end());
    }
    return kept;
}

/// Adds cells beside the body that only some of the scans have points in.
void grow(const BodyCells& cells, Body& body, std::size_t scans) {
    constexpr double kSome = 0.25;  // of the scans
    spread({body.begin(), body.end()}, [&](VoxelKey key) {
        const auto it = cells.find(key);
        if (it == cells.end() || body.contains(key)) return false;
        const BodyCell& cell = it->second;
        const bool stays = static_cast<double>(cell.scans) >= kSome * static_cast<double>(scans);
        if (!stays || cell.passes <= 2 * cell.hits) return false;
        body.insert(key);
        return true;
    });
}

/// Cells in a row along x become one box, with a margin for the noise of points at the edge.
Boxes boxes_of(const Body& body) {
    std::vector<Cell> cells;
    for (const VoxelKey key : body) cells.push_back(unpack(key));
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
        return std::make_tuple(a.z(), a.y(), a.x()) < std::make_tuple(b.z(), b.y(), b.x());
    });
    constexpr float kMargin = 0.1F;  // [m]
    Boxes boxes;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Point low = kBodyCell * cells[i].cast<float>() - Point::Constant(kMargin);
        const Point high = low + Point::Constant(kBodyCell + 2.0F * kMargin);
        const bool goes_on = i > 0 && cells[i] == cells[i - 1] + Cell(1, 0, 0);
        if (goes_on) {
            boxes.back().extend(high);
        } else {
            boxes.emplace_back(low, high);
        }
    }
    return boxes;
}

}  // namespace

OwnBody find_own_body(const Recording& recording) {
    const std::vector<BodyPair> pairs = pairs_apart(recording);
    const BeamPattern beams = beams_of(recording, pairs);
    std::vector<std::optional<BodyScan>> scans(2 * pairs.size());
    parallel_for(scans.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const auto& [a, b] = pairs[k / 2];
            try {
                scans[k] = body_scan_of(recording.read(k % 2 == 0 ? a : b), beams);
            } catch (const InputError&) {  // is rejected later, with the reason
            }
        }
    });
    BodyCells cells;
    std::size_t usable = 0, measured = 0;
    for (const auto& scan : scans) {
        if (!scan) continue;
        ++usable;
        measured += scan->measured;
        for (const Point& p : scan->near) {
            BodyCell& cell = cells[pack(*cell_of(p, 1.0F / kBodyCell))];
            ++cell.points;
            if (std::exchange(cell.last, usable) != usable) ++cell.scans;
        }
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto &a = scans[2 * k], &b = scans[2 * k + 1];
        if (!a || !b) continue;
        look_from(*a, *b, cells);
        look_from(*b, *a, cells);
    }
    constexpr double kNearlyAll = 0.8;  // of the scans
    constexpr std::size_t kSure = 4;    // looks
    Body body;
    for (const auto& [key, cell] : cells) {
        const bool stays =
            static_cast<double>(cell.scans) >= kNearlyAll * static_cast<double>(usable);
        if (stays && cell.passes >= kSure && cell.passes > 4 * cell.hits) body.insert(key);
    }
    // With wrong poses, scans look through everything.
    std::size_t passes = 0, hits = 0;
    for (const auto& [key, cell] : cells) {
        if (body.contains(key)) continue;
        passes += cell.passes;
        hits += cell.hits;
    }
    if (hits < 2 * passes) return {};
    const auto share_of_body = [&] {
        return static_cast<double>(points_of(cells, body)) / static_cast<double>(measured);
    };
    constexpr double kLeastShare = 0.003;
    body = main_parts(cells, std::move(body));
    if (measured == 0 || share_of_body() < kLeastShare) return {};
    grow(cells, body, usable);
    OwnBody found;
    found.share = share_of_body();
    found.boxes = boxes_of(body);
    return found;
}

}  // namespace dynamic_filter::io
