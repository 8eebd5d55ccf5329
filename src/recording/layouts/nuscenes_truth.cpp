// SPDX-License-Identifier: MIT
#include "recording/layouts/nuscenes_truth.hpp"

#include <algorithm>

#include "recording/folders.hpp"
#include "recording/layouts/nuscenes_tables.hpp"

namespace dynamic_filter::io::nuscenes {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

bool says_motion(const std::string& attribute) {
    return attribute.ends_with(".moving") || attribute == "cycle.with_rider";
}

/// Tokens of the attributes of what moves.
std::set<std::string> moving_attributes(const fs::path& tables) {
    std::set<std::string> moving;
    each_entry(tables / "attribute.json", [&](const Json& entry) {
        if (says_motion(text_of(entry, "name"))) moving.insert(text_of(entry, "token"));
    });
    return moving;
}

bool has_any(const Json& tokens, const std::set<std::string>& wanted) {
    return std::any_of(tokens.begin(), tokens.end(), [&](const Json& token) {
        return wanted.contains(token.get<std::string>());
    });
}

MovingBox box_of(const Json& entry, const fs::path& file) {
    const Json& size = entry.at("size");  // width, length, height; x of a box points ahead
    const Eigen::Vector3d edges(size.at(1).get<double>(), size.at(0).get<double>(),
                                size.at(2).get<double>());
    return {pose_of(entry, file).inverse(), 0.5 * edges};
}

struct Annotation {
    std::string sample, instance;
    MovingBox box;
};

}  // namespace

fs::path annotations_of(const fs::path& tables) { return tables / "sample_annotation.json"; }

std::map<std::string, std::vector<MovingBox>> moving_boxes(const fs::path& tables,
                                                           const std::set<std::string>& samples) {
    const fs::path file = annotations_of(tables);
    if (!present(file)) return {};
    std::set<std::string> attributes, moving;
    std::vector<Annotation> annotations;
    each_entry(file, [&](const Json& entry) {
        if (!samples.contains(text_of(entry, "sample_token"))) return;
        if (annotations.empty()) attributes = moving_attributes(tables);
        annotations.push_back({text_of(entry, "sample_token"), text_of(entry, "instance_token"),
                               box_of(entry, file)});
        if (has_any(entry.at("attribute_tokens"), attributes)) {
            moving.insert(annotations.back().instance);
        }
    });
    std::map<std::string, std::vector<MovingBox>> boxes;
    if (annotations.empty()) return boxes;
    for (const std::string& sample : samples) boxes[sample] = {};
    for (const Annotation& one : annotations) {
        if (moving.contains(one.instance)) boxes[one.sample].push_back(one.box);
    }
    return boxes;
}

Labels truth_by(const std::vector<MovingBox>& boxes, const Points& points,
                const Pose& T_world_sensor) {
    Labels labels(points.size(), Label::static_);
    for (const MovingBox& box : boxes) {
        const Pose T_box_sensor = box.T_box_world * T_world_sensor;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d p = T_box_sensor * points[i].cast<double>();
            if ((p.cwiseAbs().array() <= box.half.array()).all()) labels[i] = Label::dynamic;
        }
    }
    return labels;
}

}  // namespace dynamic_filter::io::nuscenes
