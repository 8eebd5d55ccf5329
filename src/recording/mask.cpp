// SPDX-License-Identifier: MIT
#include "recording/mask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "recording/mesh_mask.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {

Boxes read_boxes(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw InputError(file, "", "cannot be read; expected a file of boxes, one a line");
    Boxes boxes;
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); ++number) {
        line = line.substr(0, line.find('#'));
        std::replace(line.begin(), line.end(), ',', ' ');
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        std::istringstream words(line);
        std::array<float, 6> values{};
        std::string more;
        for (float& value : values) words >> value;
        const Point low(values[0], values[1], values[2]), high(values[3], values[4], values[5]);
        const bool is_box = words && !(words >> more) && (low.array() < high.array()).all();
        if (!is_box) {
            throw InputError(file, fmt::format("line {}", number),
                             "expected six numbers: the lowest x y z of a box and its highest x y "
                             "z, in metres in the sensor's frame");
        }
        boxes.emplace_back(low, high);
    }
    if (boxes.empty()) throw InputError(file, "", "has no box; expected one a line");
    return boxes;
}

Boxes read_mask(const std::filesystem::path& file) {
    return to_lower(file.extension().string()) == ".stl" ? boxes_in(read_stl(file))
                                                         : read_boxes(file);
}

std::vector<std::uint8_t> take_out(const Boxes& boxes, const Pose& T_body_sensor, Points& points) {
    Eigen::AlignedBox3f around;
    for (const Eigen::AlignedBox3f& box : boxes) around.extend(box);
    const Eigen::Isometry3f T = T_body_sensor.cast<float>();
    const bool is_turned = !T.matrix().isIdentity(0.0F);
    std::vector<std::uint8_t> own;
    if (boxes.empty()) return own;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point at = is_turned ? Point(T * points[i]) : points[i];
        const auto holds = [&](const Eigen::AlignedBox3f& box) { return box.contains(at); };
        if (!is_measured(points[i]) || !holds(around) ||
            std::none_of(boxes.begin(), boxes.end(), holds)) {
            continue;
        }
        own.resize(points.size());
        own[i] = 1;
        points[i].setZero();
    }
    return own;
}

void label_own_body(const std::vector<std::uint8_t>& own, Labels& labels) {
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i] != 0) labels[i] = Label::dynamic;
    }
}

Recording with_own_body(const Recording& recording, Boxes boxes) {
    RecordingParts parts = recording.parts();
    parts.info.own_body = std::move(boxes);
    return Recording(std::move(parts));
}

}  // namespace dynamic_filter::io
