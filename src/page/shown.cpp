// SPDX-License-Identifier: MIT
#include "page/shown.hpp"

#include <algorithm>
#include <utility>

#include "dynamic_filter/writers.hpp"
#include "formats/label_files.hpp"
#include "geometry/verdict_code.hpp"
#include "page/sampling.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

/// 3: not kept.
std::uint8_t code_at(const Labels& labels, std::size_t i) {
    return labels.empty() ? std::uint8_t{3} : verdict_code(labels[i]);
}

/// Chooses about `most` measured points of a scan at random. Up to half of them are dynamic.
std::vector<std::uint32_t> drawn(const io::FullScan& full, const Labels& labels, std::size_t scan,
                                 std::size_t most) {
    const auto moving =
        static_cast<double>(std::count(labels.begin(), labels.end(), Label::dynamic));
    const double others = static_cast<double>(labels.size()) - moving,
                 room = static_cast<double>(most);
    const double room_of_moving = std::min(moving, std::max(0.5 * room, room - others));
    const double share_of_moving = moving > 0 ? room_of_moving / moving : 0.0,
                 share_of_others = others > 0 ? (room - room_of_moving) / others : 0.0;
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const double share = labels[i] == Label::dynamic ? share_of_moving : share_of_others;
        if (is_sampled(scan, i, share) && is_measured(full.points[i])) {
            chosen.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return chosen;
}

/// About `most` points of one scan. `intensity`: of all its points, or empty.
std::vector<ShownPoint> draw(const ViewInput& in, std::size_t row, const io::FullScan& full,
                             const Labels& labels, const std::vector<double>& intensity,
                             const Eigen::Vector3d& origin, std::size_t most) {
    const std::size_t index = in.scans[row].index;
    const auto chosen = drawn(full, labels, index, most);
    Scan scan{{}, full.T_world_sensor, full.stamp, index};
    for (const std::uint32_t i : chosen) scan.points.push_back(full.points[i]);
    const auto places = in.voxels_of(scan);
    Pose T_page_sensor = full.T_world_sensor;
    T_page_sensor.translation() -= origin;
    const Labels instant = in.instant(index);
    std::vector<ShownPoint> points;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const std::uint32_t i = chosen[k];
        const auto verdict = static_cast<std::uint8_t>(
            verdict_code(labels[i]) | code_at(full.truth, i) << 2 | code_at(instant, i) << 4);
        points.push_back({(T_page_sensor * scan.points[k].cast<double>()).cast<float>(),
                          intensity.empty() ? 0.0F : static_cast<float>(intensity[i]),
                          static_cast<std::uint32_t>(row), verdict, places[k]});
    }
    return points;
}

/// The points of one scan that are shown.
struct Drawn {
    std::vector<ShownPoint> map, frame;
    bool has_intensity = false;
};

/// The stride that takes about `most` of `count`, and no more.
std::size_t stride_for(std::size_t count, std::size_t most) {
    return std::max<std::size_t>(1, (count + most - 1) / most);
}

}  // namespace

bool is_shown(std::size_t index, std::size_t scans) {
    return index % stride_for(scans, kFrames) == 0;
}

std::vector<double> intensities(const io::Cloud& cloud) {
    const io::Field* field = cloud.find("intensity");
    return field == nullptr ? std::vector<double>{} : values(cloud, *field);
}

Shown collect(const ViewInput& in, const Eigen::Vector3d& origin) {
    constexpr std::size_t kMostScans = 2000;  // more do not show in so few points
    constexpr std::size_t kPerMapPoint = 4;   // offered, so that the cubes are well filled
    const std::size_t n = in.scans.size(), stride = stride_for(n, kMostScans);
    const auto is_frame = [&](std::size_t i) { return is_shown(i, in.recording.size()); };
    std::vector<std::size_t> scans, row_of(in.recording.size());
    std::size_t frames = 0;
    for (std::size_t row = 0; row < n; ++row) {
        if (row % stride != 0 && !is_frame(in.scans[row].index)) continue;
        scans.push_back(in.scans[row].index);
        row_of[scans.back()] = row;
        if (is_frame(scans.back())) ++frames;
    }
    const std::size_t for_map = kPerMapPoint * kMapPoints / std::max<std::size_t>(1, scans.size()),
                      for_frame = kFramePoints / std::max<std::size_t>(1, frames);
    Shown shown{.map = ThinnedCloud(kMapPoints)};
    shown.frame_of_scan.assign(n, -1);
    std::vector<Drawn> drawn(in.recording.size());
    const auto draw_both = [&](std::size_t i, MaybeScan& maybe) {
        const Labels labels = io::read_labels(io::label_file(in.labels, io::stem(in.recording, i)));
        const std::size_t row = row_of[i];
        const auto intensity = in.recording.info().intensity_is_truth
                                   ? std::vector<double>{}
                                   : intensities(maybe.scan->cloud);
        drawn[i].has_intensity = !intensity.empty();
        drawn[i].map = draw(in, row, *maybe.scan, labels, intensity, origin, for_map);
        if (is_frame(i)) drawn[i].frame = draw(in, row, *maybe.scan, labels, {}, origin, for_frame);
    };
    const auto use = [&](std::size_t i, MaybeScan& maybe) {
        if (!maybe.scan) return true;  // it was readable a moment ago; the page can do without
        const Drawn points = std::exchange(drawn[i], {});
        shown.has_intensity |= points.has_intensity;
        shown.map.add(points.map);
        if (is_frame(i)) {
            shown.frame_of_scan[row_of[i]] = static_cast<std::int32_t>(shown.frame_begin.size());
            shown.frame_begin.push_back(static_cast<std::uint32_t>(shown.frames.size()));
            shown.frames.insert(shown.frames.end(), points.frame.begin(), points.frame.end());
        }
        return true;
    };
    for_each_scan(in.recording, scans, draw_both, use);
    shown.frame_begin.push_back(static_cast<std::uint32_t>(shown.frames.size()));
    return shown;
}

}  // namespace dynamic_filter::app
