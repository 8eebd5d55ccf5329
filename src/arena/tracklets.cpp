// SPDX-License-Identifier: MIT
#include "arena/tracklets.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>

#include "base/degree.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace dynamic_filter::app {

namespace {

using tinyxml2::XMLElement;

constexpr double kRim = 0.2;                   // [m]
constexpr double kNear = 3.0, kFar = 60.0;     // [m]
constexpr double kSeen = 40.0;                 // [deg] to either side of ahead
constexpr double kMoves = 1.5, kRests = 0.75;  // [m]

/// Reads the elements of a file, and knows its name for messages.
struct Reader {
    const std::filesystem::path& file;

    [[noreturn]] void fail(const XMLElement& in, const std::string& what) const {
        throw InputError(file, fmt::format("line {}", in.GetLineNum()), what);
    }
    [[nodiscard]] const XMLElement& child(const XMLElement& in, const char* name) const {
        const XMLElement* found = in.FirstChildElement(name);
        if (!found) fail(in, fmt::format("<{}> has no <{}>", in.Name(), name));
        return *found;
    }
    [[nodiscard]] double number(const XMLElement& in, const char* name) const {
        const XMLElement& element = child(in, name);
        const auto value = io::parse_real(element.GetText() ? element.GetText() : "");
        if (!value || !std::isfinite(*value)) fail(element, fmt::format("<{}> is no number", name));
        return *value;
    }
    [[nodiscard]] Pose pose(const XMLElement& item) const {
        const double x = number(item, "tx"), y = number(item, "ty"), z = number(item, "tz");
        Pose pose(Eigen::Translation3d(x, y, z));
        // Only the yaw is used in the data set; the other two are 0.
        pose.rotate(Eigen::AngleAxisd(number(item, "rz"), Eigen::Vector3d::UnitZ()));
        return pose;
    }
    [[nodiscard]] Tracklet track(const XMLElement& item) const {
        const char* type = child(item, "objectType").GetText();
        Tracklet track{.type = type ? type : "",
                       .size = {number(item, "l"), number(item, "w"), number(item, "h")}};
        const double first = number(item, "first_frame");
        if (first < 0 || first != std::floor(first))
            fail(item, "<first_frame> is no number of a scan");
        track.first_scan = static_cast<std::size_t>(first);
        const XMLElement& poses = child(item, "poses");
        for (const XMLElement* one = poses.FirstChildElement("item"); one;
             one = one->NextSiblingElement("item")) {
            track.T_sensor_box.push_back(pose(*one));
        }
        return track;
    }
};

/// The distance of a point from the nearest side of the box; negative inside.
double outside(const Eigen::Vector3d& in_box, const Eigen::Vector3d& size) {
    const Eigen::Vector3d middle(0.0, 0.0, 0.5 * size.z());
    return ((in_box - middle).cwiseAbs() - 0.5 * size).maxCoeff();
}

bool is_looked_at(const Point& point) {
    const double far = point.head<2>().norm();
    const double angle = std::abs(std::atan2(point.y(), point.x()));
    return is_measured(point) && far >= kNear && far <= kFar && angle <= kSeen * io::kDegree;
}

}  // namespace

std::vector<Tracklet> read_tracklets(const std::filesystem::path& file) {
    tinyxml2::XMLDocument document;
    const std::string text = io::read_file(file);
    if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) {
        throw InputError(file, fmt::format("line {}", document.ErrorLineNum()),
                         "is not whole XML; expected KITTI's tracklets");
    }
    const XMLElement* top = document.FirstChildElement("boost_serialization");
    if (!top)
        throw InputError(file, "", "has no <boost_serialization>; expected KITTI's tracklets");
    const Reader reader{file};
    std::vector<Tracklet> tracks;
    const XMLElement& list = reader.child(*top, "tracklets");
    for (const XMLElement* item = list.FirstChildElement("item"); item;
         item = item->NextSiblingElement("item")) {
        tracks.push_back(reader.track(*item));
    }
    return tracks;
}

Label motion_of(const Tracklet& track, const std::vector<Pose>& T_world_sensor) {
    std::vector<Eigen::Vector3d> middles;
    for (std::size_t i = 0; i < track.T_sensor_box.size(); ++i) {
        const std::size_t scan = track.first_scan + i;
        if (scan >= T_world_sensor.size() || !T_world_sensor[scan].matrix().allFinite()) continue;
        middles.emplace_back(T_world_sensor[scan] * track.T_sensor_box[i].translation());
    }
    double farthest = 0.0;
    for (std::size_t a = 0; a < middles.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            farthest = std::max(farthest, (middles[a] - middles[b]).norm());
        }
    }
    if (farthest > kMoves) return Label::dynamic;
    return farthest > kRests ? Label::unknown : Label::static_;
}

Labels truth_by_tracklets(const std::vector<Tracklet>& tracks, const Labels& motions,
                          std::size_t scan, const Points& points) {
    Labels labels(points.size(), Label::unknown);
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (is_looked_at(points[p])) labels[p] = Label::static_;
    }
    for (std::size_t t = 0; t < tracks.size(); ++t) {
        const Tracklet& track = tracks[t];
        const bool is_there =
            scan >= track.first_scan && scan - track.first_scan < track.T_sensor_box.size();
        if (!is_there || motions[t] == Label::static_) continue;
        const Pose T_box_sensor = track.T_sensor_box[scan - track.first_scan].inverse();
        for (std::size_t p = 0; p < points.size(); ++p) {
            if (labels[p] == Label::unknown) continue;
            const Eigen::Vector3d in_box = T_box_sensor * points[p].cast<double>();
            const double far = outside(in_box, track.size);
            if (far > kRim) continue;
            // The lowest part of a box holds the ground under the thing, too.
            const bool is_its = motions[t] == Label::dynamic && far <= 0.0 && in_box.z() > kRim;
            labels[p] = is_its ? Label::dynamic : Label::unknown;
        }
    }
    return labels;
}

}  // namespace dynamic_filter::app
