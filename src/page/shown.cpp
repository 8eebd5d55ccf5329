// SPDX-License-Identifier: MIT
#include "page/shown.hpp"

#include <algorithm>
#include <utility>

#include "geometry/pose.hpp"
#include "geometry/verdict_code.hpp"
#include "page/sampling.hpp"

namespace dynamic_filter::app {

namespace {

/// 3: not kept.
std::uint8_t code_at(const Labels& labels, std::size_t i) {
    return labels.empty() ? std::uint8_t{3} : verdict_code(labels[i]);
}

/// The shares of the points of a scan that make about `most` points. Up to half of these are
/// dynamic.
struct Shares {
    double moving, others;
};
Shares shares_of(const Labels& labels, std::size_t most) {
    const auto moving =
        static_cast<double>(std::count(labels.begin(), labels.end(), Label::dynamic));
    const double others = static_cast<double>(labels.size()) - moving,
                 room = static_cast<double>(most);
    const double room_of_moving = std::min(moving, std::max(0.5 * room, room - others));
    return {moving > 0 ? room_of_moving / moving : 0.0,
            others > 0 ? (room - room_of_moving) / others : 0.0};
}

/// The stride that takes about `most` of `count`, and no more.
std::size_t stride_for(std::size_t count, std::size_t most) {
    return std::max<std::size_t>(1, (count + most - 1) / most);
}

/// Points of one scan, chosen at random.
struct Chosen {
    std::vector<std::uint32_t> for_map, for_frame;
};
/// About so many measured points for either. A point is drawn once: the smaller sample is a part of
/// the larger one.
Chosen choose(std::size_t index, const io::FullScan& full, const Labels& labels,
              std::size_t for_map, std::size_t for_frame) {
    const Shares map = shares_of(labels, for_map), frame = shares_of(labels, for_frame);
    Chosen chosen;
    for (std::uint32_t i = 0; i < labels.size(); ++i) {
        const bool moves = labels[i] == Label::dynamic;
        const double lot = lot_of(index, i);
        const bool is_in_map = lot < (moves ? map.moving : map.others),
                   is_in_frame = lot < (moves ? frame.moving : frame.others);
        if (!(is_in_map || is_in_frame) || !is_measured(full.points[i])) continue;
        if (is_in_map) chosen.for_map.push_back(i);
        if (is_in_frame) chosen.for_frame.push_back(i);
    }
    return chosen;
}

void place(std::vector<ShownPoint>& points, const Pose& T_page_sensor) {
    for (ShownPoint& p : points) {
        p.position = (T_page_sensor * p.position.cast<double>()).cast<float>();
    }
}

}  // namespace

bool is_shown(std::size_t index, std::size_t scans) {
    return index % stride_for(scans, kFrames) == 0;
}

std::vector<double> intensities(const io::Cloud& cloud) {
    const io::Field* field = cloud.find("intensity");
    return field == nullptr ? std::vector<double>{} : values(cloud, *field);
}

ShownScans::ShownScans(const std::vector<std::size_t>& scans, std::size_t recorded,
                       VoxelsOf voxels_of)
    : rows_(recorded), voxels_of_(std::move(voxels_of)) {
    constexpr std::size_t kMostScans = 2000;  // more do not show in so few points
    constexpr std::size_t kPerMapPoint = 2;   // offered, so that the cubes are well filled
    stride_ = stride_for(scans.size(), kMostScans);
    std::size_t frames = 0, asked = 0;
    for (std::uint32_t row = 0; row < scans.size(); ++row) {
        rows_[scans[row]] = row;
        frames += is_frame(scans[row]) ? 1 : 0;
        asked += is_asked(scans[row]) ? 1 : 0;
    }
    for_map_ = kPerMapPoint * kMapPoints / std::max<std::size_t>(1, asked);
    for_frame_ = kFramePoints / std::max<std::size_t>(1, frames);
    shown_.frame_of_scan.assign(scans.size(), -1);
}

bool ShownScans::is_asked(std::size_t scan) const {
    return rows_[scan] % stride_ == 0 || is_frame(scan);
}

ShownScans::Drawn ShownScans::draw(std::size_t scan, const io::FullScan& full, const Labels& labels,
                                   const Labels& instant,
                                   const std::vector<double>& intensity) const {
    Drawn drawn{.T_world_sensor = full.T_world_sensor, .has_intensity = !intensity.empty()};
    if (!is_asked(scan)) return drawn;
    const Chosen chosen =
        choose(scan, full, labels, for_map_, is_frame(scan) ? for_frame_ : std::size_t{0});
    const auto shown = [&](const std::vector<std::uint32_t>& at, bool with_intensity) {
        Scan some{{}, full.T_world_sensor, full.stamp, scan};
        for (const std::uint32_t i : at) some.points.push_back(full.points[i]);
        const std::vector<std::uint64_t> places = voxels_of_(some);
        std::vector<ShownPoint> points;
        points.reserve(at.size());
        for (std::size_t k = 0; k < at.size(); ++k) {
            const std::uint32_t i = at[k];
            const auto verdict = static_cast<std::uint8_t>(
                verdict_code(labels[i]) | code_at(full.truth, i) << 2 | code_at(instant, i) << 4);
            points.push_back({full.points[i],
                              with_intensity ? static_cast<float>(intensity[i]) : 0.0F, rows_[scan],
                              verdict, places[k]});
        }
        return points;
    };
    drawn.map = shown(chosen.for_map, drawn.has_intensity);
    drawn.frame = shown(chosen.for_frame, false);
    return drawn;
}

void ShownScans::add(std::size_t scan, Drawn drawn) {
    if (rows_[scan] == 0) shown_.origin = nearby_origin(drawn.T_world_sensor, 1.0);
    if (!is_asked(scan)) return;
    Pose T_page_sensor = drawn.T_world_sensor;
    T_page_sensor.translation() -= shown_.origin;
    place(drawn.map, T_page_sensor);
    place(drawn.frame, T_page_sensor);
    shown_.has_intensity |= drawn.has_intensity;
    shown_.map.add(drawn.map);
    if (!is_frame(scan)) return;
    shown_.frame_of_scan[rows_[scan]] = static_cast<std::int32_t>(shown_.frame_begin.size());
    shown_.frame_begin.push_back(static_cast<std::uint32_t>(shown_.frames.size()));
    shown_.frames.insert(shown_.frames.end(), drawn.frame.begin(), drawn.frame.end());
}

Shown ShownScans::take() {
    shown_.frame_begin.push_back(static_cast<std::uint32_t>(shown_.frames.size()));
    return std::exchange(shown_, {});
}

}  // namespace dynamic_filter::app
