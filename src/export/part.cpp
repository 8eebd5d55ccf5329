// SPDX-License-Identifier: MIT
#include "export/part.hpp"

#include <limits>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "export/places.hpp"
#include "export/sink.hpp"
#include "export/thinned_records.hpp"
#include "recording/world_records.hpp"

namespace dynamic_filter::app {

std::optional<Box> box_of(const std::string& text) {
    if (text.empty()) return std::nullopt;
    constexpr double kAny = std::numeric_limits<double>::infinity();
    std::vector<double> numbers = io::parse_reals(text);
    if (numbers.size() == 4) {  // x, y, x, y
        numbers.insert(numbers.begin() + 2, -kAny);
        numbers.push_back(kAny);
    }
    if (numbers.size() != 6) {
        throw ConfigError("--box " + text +
                          ": expected two corners in metres, X,Y,Z,X,Y,Z, such as "
                          "-10,-10,-1,10,10,3, or X,Y,X,Y for all heights");
    }
    Box box;
    box.extend(Eigen::Vector3d(numbers[0], numbers[1], numbers[2]));
    box.extend(Eigen::Vector3d(numbers[3], numbers[4], numbers[5]));
    return box;
}

std::vector<std::uint32_t> wanted_points(const Wanted& part, const io::FullScan& scan,
                                         const Labels& labels) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
        const Point& point = scan.points[i];
        if (!part.takes_all() && !is_measured(point)) continue;
        if (part.max_range > 0.0 &&
            !((point.cast<double>() - part.sensor).norm() <= part.max_range))
            continue;
        if (part.box && !part.box->contains(scan.T_world_sensor * point.cast<double>())) continue;
        if (part.only && where(labels[i], false, part.keep_unknown) != *part.only) continue;
        wanted.push_back(i);
    }
    return wanted;
}

std::vector<std::uint32_t> wanted_points(const Box& box, const io::Cloud& cloud) {
    const std::vector<Eigen::Vector3d> places = places_of(cloud);
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        if (box.contains(places[i])) wanted.push_back(i);
    }
    return wanted;
}

ThinnedPart thinned(const io::Cloud& cloud, double cell) {
    const std::vector<Eigen::Vector3d> places = places_of(cloud);
    const io::Field* const dynamic = cloud.find("dynamic");
    const std::vector<double> moves =
        dynamic != nullptr ? io::values(cloud, *dynamic) : std::vector<double>(cloud.size());
    ThinnedRecords records(cell);
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!places[i].allFinite()) {
            ++left_out;
            continue;
        }
        records.add(places[i], records.distance_to_middle(places[i]), moves[i] != 0.0,
                    std::span(cloud.data).subspan(i * cloud.point_bytes, cloud.point_bytes));
    }
    io::Cloud part = without_records(cloud);
    part.data = records.records();
    return {std::move(part), left_out};
}

io::Cloud part_of(const io::Cloud& cloud, std::span<const std::uint32_t> points) {
    io::Cloud part = without_records(cloud);
    part.data.reserve(points.size() * cloud.point_bytes);
    for (const std::uint32_t i : points) append_record(part.data, cloud.data, i, cloud.point_bytes);
    return part;
}

io::FullScan part_of(const io::FullScan& scan, std::span<const std::uint32_t> points) {
    io::FullScan part;
    part.cloud = part_of(scan.cloud, points);
    part.points = part_of(scan.points, points);
    part.T_world_sensor = scan.T_world_sensor;
    part.has_pose = scan.has_pose;
    part.stamp = scan.stamp;
    part.times = part_of(scan.times, points);
    part.truth = part_of(scan.truth, points);
    part.truth_fault = scan.truth_fault;
    part.own = part_of(scan.own, points);
    return part;
}

}  // namespace dynamic_filter::app
