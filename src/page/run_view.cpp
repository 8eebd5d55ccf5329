// SPDX-License-Identifier: MIT
#include "page/run_view.hpp"

#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/json_vector.hpp"
#include "base/numbers.hpp"
#include "geometry/pose.hpp"
#include "page/sampling.hpp"
#include "page/shown.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

using nlohmann::ordered_json;
using Origin = Eigen::Vector3d;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Positions as whole steps from a corner.
struct Steps {
    Point low = Point::Zero();
    float step = 0.001F;  ///< [m]

    explicit Steps(std::initializer_list<const std::vector<ShownPoint>*> clouds) {
        constexpr float kMost = 65535.0F;
        Eigen::AlignedBox3f box;
        for (const auto* cloud : clouds) {
            for (const ShownPoint& p : *cloud) box.extend(p.position);
        }
        if (box.isEmpty()) return;
        low = box.min();
        step = std::max(step, box.sizes().maxCoeff() / kMost);
    }
    [[nodiscard]] std::vector<std::uint16_t> of(const std::vector<ShownPoint>& cloud) const {
        std::vector<std::uint16_t> steps;
        steps.reserve(3 * cloud.size());
        for (const ShownPoint& p : cloud) {
            for (int axis = 0; axis < 3; ++axis) {
                const float at = (p.position[axis] - low[axis]) / step;
                steps.push_back(static_cast<std::uint16_t>(std::lround(std::min(at, 65535.0F))));
            }
        }
        return steps;
    }
};

template <class Get>
auto column(const std::vector<ShownPoint>& cloud, const Get& get) {
    std::vector<decltype(get(cloud.front()))> values;
    values.reserve(cloud.size());
    for (const ShownPoint& p : cloud) values.push_back(get(p));
    return values;
}

std::vector<std::uint8_t> scaled_intensity(const std::vector<ShownPoint>& cloud) {
    std::vector<float> finite = column(cloud, [](const ShownPoint& p) { return p.intensity; });
    std::erase_if(finite, [](float value) { return !std::isfinite(value); });
    const float top = std::max(1e-6F, usual_most(std::move(finite)));
    return column(cloud, [&](const ShownPoint& p) {
        const float share = std::isfinite(p.intensity) ? p.intensity / top : 0.0F;
        return static_cast<std::uint8_t>(255.0F * std::clamp(share, 0.0F, 1.0F));
    });
}

/// Rows for the voxels of all points shown, in the order in which they are met.
class VoxelRows {
public:
    std::vector<std::uint32_t> rows_of(const std::vector<ShownPoint>& cloud) {
        return column(cloud, [&](const ShownPoint& p) {
            if (p.place == kNoVoxelOfPage) return kNone;
            const auto [it, is_new] =
                rows_.emplace(p.place, static_cast<std::uint32_t>(places_.size()));
            if (is_new) places_.push_back(p.place);
            return it->second;
        });
    }
    [[nodiscard]] const std::vector<std::uint64_t>& places() const { return places_; }

private:
    tsl::robin_map<std::uint64_t, std::uint32_t, VoxelHash> rows_;
    std::vector<std::uint64_t> places_;
};

/// Row of the path that belongs to an index in the recording.
std::uint32_t row_of(const std::vector<ScanNote>& scans, std::size_t index) {
    const auto it = std::lower_bound(scans.begin(), scans.end(), index,
                                     [](const ScanNote& n, std::size_t i) { return n.index < i; });
    return static_cast<std::uint32_t>(it - scans.begin());
}

void add_voxels(const ViewInput& in, const std::vector<std::uint64_t>& places, PageRun& run) {
    std::vector<std::size_t> keyframes = in.keyframes;
    constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
    if (keyframes.size() > kMost) keyframes.erase(keyframes.begin(), keyframes.end() - kMost);
    std::vector<std::uint8_t> probability;
    std::vector<std::uint16_t> evidence, pass;
    std::vector<float> score;
    std::vector<std::uint32_t> span, pass_begin;
    for (const VoxelHistory& h : in.histories(places)) {
        probability.push_back(h.probability
                                  ? static_cast<std::uint8_t>(std::lround(254.0F * *h.probability))
                                  : std::uint8_t{255});
        for (const std::uint32_t count : {h.n_occ, h.n_free, h.n_own, h.n_switch}) {
            evidence.push_back(static_cast<std::uint16_t>(std::min<std::uint32_t>(count, kMost)));
        }
        score.insert(score.end(), {h.free, h.expected_free, h.score});
        span.insert(span.end(), {row_of(in.scans, h.first), row_of(in.scans, h.last)});
        pass_begin.push_back(static_cast<std::uint32_t>(pass.size()));
        for (const std::size_t index : h.free_keyframes) {
            const auto it = std::lower_bound(keyframes.begin(), keyframes.end(), index);
            if (it == keyframes.end() || *it != index) continue;
            pass.push_back(static_cast<std::uint16_t>(it - keyframes.begin()));
        }
    }
    pass_begin.push_back(static_cast<std::uint32_t>(pass.size()));
    run.arrays.push_back(page_array("voxel-probability", 1, probability));
    if (!in.has_evidence) return;
    run.arrays.push_back(page_array("voxel-evidence", 4, evidence));
    run.arrays.push_back(page_array("voxel-score", 3, score));
    run.arrays.push_back(page_array("voxel-span", 2, span));
    run.arrays.push_back(page_array("pass-begin", 1, pass_begin));
    run.arrays.push_back(page_array("pass", 1, pass));
    auto& rows = run.info["keyframes"] = ordered_json::array();
    for (const std::size_t index : keyframes) rows.push_back(row_of(in.scans, index));
}

void add_path(const ViewInput& in, const Shown& shown, const Origin& origin, PageRun& run) {
    std::vector<float> position;
    std::vector<double> stamp;
    std::vector<std::uint32_t> index, counts, scores;
    for (const ScanNote& note : in.scans) {
        const Point at = (note.position - origin).cast<float>();
        position.insert(position.end(), {at.x(), at.y(), at.z()});
        stamp.push_back(note.stamp);
        index.push_back(static_cast<std::uint32_t>(note.index));
        counts.insert(counts.end(), note.counts.begin(), note.counts.end());
        counts.push_back(note.corrected);
        scores.insert(scores.end(), note.scores.begin(), note.scores.end());
    }
    run.arrays.push_back(page_array("path-position", 3, position));
    run.arrays.push_back(page_array("path-stamp", 1, stamp));
    run.arrays.push_back(page_array("path-index", 1, index));
    run.arrays.push_back(page_array("path-frame", 1, shown.frame_of_scan));
    run.arrays.push_back(page_array("path-counts", 4, counts));
    if (in.recording.info().has_truth()) run.arrays.push_back(page_array("path-scores", 8, scores));
}

/// Which sensor of several made each scan, so that each can be hidden.
void add_sensors(const ViewInput& in, PageRun& run) {
    if (in.sensors.size() < 2) return;
    run.info["groups"] = {{"kind", "sensor"}, {"names", in.sensors}};
    std::vector<std::uint8_t> sensor;
    for (const ScanNote& note : in.scans) sensor.push_back(static_cast<std::uint8_t>(note.sensor));
    run.arrays.push_back(page_array("path-sensor", 1, sensor));
}

void add_objects(const ViewInput& in, const Origin& origin, PageRun& run) {
    run.info["objects_total"] = in.objects_total;
    std::vector<std::uint32_t> number, row, begin, place_row;
    std::vector<float> facts, place;
    for (const ObjectWay& way : in.objects) {
        number.push_back(way.object);
        for (const std::size_t scan : {way.first, way.last, way.nearest}) {
            row.push_back(row_of(in.scans, scan));
        }
        for (const double fact : {static_cast<double>(way.points), way.size.x(), way.size.y(),
                                  way.size.z(), way.path, way.fastest}) {
            facts.push_back(static_cast<float>(fact));
        }
        begin.push_back(static_cast<std::uint32_t>(place_row.size()));
        for (const ObjectWay::Place& at : way.places) {
            const Point here = (at.center - origin).cast<float>();
            place.insert(place.end(), {here.x(), here.y(), here.z()});
            place_row.push_back(row_of(in.scans, at.scan));
        }
    }
    begin.push_back(static_cast<std::uint32_t>(place_row.size()));
    run.arrays.push_back(page_array("object-number", 1, number));
    run.arrays.push_back(page_array("object-row", 3, row));
    run.arrays.push_back(page_array("object-facts", 6, facts));
    run.arrays.push_back(page_array("object-begin", 1, begin));
    run.arrays.push_back(page_array("object-place", 3, place));
    run.arrays.push_back(page_array("object-place-row", 1, place_row));
}

void add_geometry(const Steps& steps, const Origin& origin, PageRun& run) {
    run.info["origin"] = array_of(origin);
    run.info["low"] = array_of(steps.low.cast<double>());
    run.info["step"] = steps.step;
}

void add_cloud(const std::vector<ShownPoint>& cloud, const std::string& prefix, const Steps& steps,
               PageRun& run) {
    run.arrays.push_back(page_array(prefix + "-position", 3, steps.of(cloud)));
    run.arrays.push_back(page_array(prefix + "-verdict", 1,
                                    column(cloud, [](const ShownPoint& p) { return p.verdict; })));
}

std::size_t frame_points(const ViewInput& in, const Shown& shown) {
    std::size_t sum = 0;
    for (std::size_t row = 0; row < in.scans.size(); ++row) {
        if (shown.frame_of_scan[row] < 0) continue;
        for (const std::uint32_t count : in.scans[row].counts) sum += count;
    }
    return sum;
}

std::size_t all_points(const ViewInput& in) {
    std::size_t sum = 0;
    for (const ScanNote& note : in.scans) {
        for (const std::uint32_t count : note.counts) sum += count;
    }
    return sum;
}

}  // namespace

ScanNote note_of(const Labels& labels, const Labels& instant, const Labels& truth) {
    ScanNote note;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Label label = labels[i];
        ++note.counts[label == Label::static_ ? 0U : label == Label::dynamic ? 1U : 2U];
        if (!instant.empty() && instant[i] != label) ++note.corrected;
        if (truth.empty() || truth[i] == Label::unknown) continue;
        const std::size_t row = truth[i] == Label::dynamic ? 0 : 2;
        const bool right = (label == Label::dynamic) == (truth[i] == Label::dynamic);
        ++note.scores[row + (right ? 0 : 1)];
        if (instant.empty()) continue;
        const bool was_right = (instant[i] == Label::dynamic) == (truth[i] == Label::dynamic);
        ++note.scores[4 + row + (was_right ? 0 : 1)];
    }
    if (instant.empty()) note.corrected = kNone;
    return note;
}

PageRun view_of(const ViewInput& in) {
    PageRun run;
    const Shown& shown = in.shown;
    const Origin& origin = shown.origin;
    const std::vector<ShownPoint> map = shuffled(shown.map.points());
    const Steps steps{&map, &shown.frames};
    add_geometry(steps, origin, run);
    run.info["scans"] = in.scans.size();
    run.info["has_truth"] = in.recording.info().has_truth();
    run.info["has_instant"] = true;
    run.info["has_evidence"] = in.has_evidence;
    run.info["points_total"] = all_points(in);
    run.info["points_shown"] = map.size();
    run.info["spacing"] = shown.map.spacing();
    run.info["frame_points_total"] = frame_points(in, shown);
    run.info["frame_points_shown"] = shown.frames.size();
    run.info["frames_shown"] = shown.frame_begin.size() - 1;
    add_cloud(map, "map", steps, run);
    if (shown.has_intensity) {
        run.arrays.push_back(page_array("map-intensity", 1, scaled_intensity(map)));
    }
    run.arrays.push_back(
        page_array("map-scan", 1, column(map, [](const ShownPoint& p) { return p.scan; })));
    VoxelRows voxels;
    run.arrays.push_back(page_array("map-voxel", 1, voxels.rows_of(map)));
    add_path(in, shown, origin, run);
    add_sensors(in, run);
    add_objects(in, origin, run);
    run.arrays.push_back(page_array("frame-begin", 1, shown.frame_begin));
    add_cloud(shown.frames, "frame", steps, run);
    run.arrays.push_back(page_array("frame-voxel", 1, voxels.rows_of(shown.frames)));
    add_voxels(in, voxels.places(), run);
    return run;
}

PageRun view_of(const io::Cloud& cloud) {
    PageRun run;
    const auto intensity = intensities(cloud);
    const Origin origin = origin_of(cloud);
    const Points points = positions_from(cloud, origin);
    std::vector<ShownPoint> finite;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].allFinite()) continue;
        constexpr std::uint8_t kStatic = 1U | 3U << 2U | 3U << 4U;
        finite.push_back({points[i], intensity.empty() ? 0.0F : static_cast<float>(intensity[i]), 0,
                          kStatic, kNoVoxelOfPage});
    }
    ThinnedCloud thinned(kMapPoints);
    thinned.add(finite);
    const std::vector<ShownPoint> map = shuffled(thinned.points());
    const Steps steps{&map};
    add_geometry(steps, origin, run);
    run.info["scans"] = 0;
    for (const char* no : {"has_truth", "has_instant", "has_evidence"}) run.info[no] = false;
    run.info["points_total"] = points.size();
    run.info["points_shown"] = map.size();
    run.info["spacing"] = thinned.spacing();
    add_cloud(map, "map", steps, run);
    if (!intensity.empty()) {
        run.arrays.push_back(page_array("map-intensity", 1, scaled_intensity(map)));
    }
    return run;
}

}  // namespace dynamic_filter::app
