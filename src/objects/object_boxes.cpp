// SPDX-License-Identifier: MIT
#include "objects/object_boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/json_vector.hpp"
#include "base/numbers.hpp"
#include "geometry/angle.hpp"

namespace dynamic_filter::app {

void WayLength::add(double stamp, const Eigen::Vector3d& center) {
    constexpr double kStep = 1.0;  // [s]
    if (!since_) since_ = stamp, from_ = center;
    last_ = center;
    if (stamp - *since_ < kStep) return;
    way_ = so_far();
    since_ = stamp;
    from_ = center;
}

double WayLength::so_far() const { return way_ + (last_ - from_).head<2>().norm(); }

ObjectBox box_around(std::span<const Eigen::Vector3d> places, double yaw) {
    const Eigen::AngleAxisd turn(yaw, Eigen::Vector3d::UnitZ());
    const Eigen::Matrix3d back = turn.inverse().toRotationMatrix();
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& place : places) box.extend(back * place);
    ObjectBox result;
    result.center = turn * box.center();
    result.size = box.sizes();
    result.yaw = yaw;
    result.points = places.size();
    return result;
}

Eigen::Vector3d usual_size(std::span<const Eigen::Vector3d> sizes) {
    Eigen::Vector3d usual;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> along;
        for (const Eigen::Vector3d& size : sizes) along.push_back(size[axis]);
        usual[axis] = value_at_rank(std::move(along), 9 * (sizes.size() - 1) / 10);
    }
    return usual;
}

std::vector<ObjectSummary> summaries_of(const std::vector<ObjectBox>& boxes) {
    std::map<std::uint32_t, ObjectSummary> by_number;
    for (const ObjectBox& box : boxes) {
        ObjectSummary& object = by_number[box.object];
        object.object = box.object;
        object.boxes.push_back(&box);
        object.points += box.points;
        object.fastest = std::max(object.fastest, box.velocity.norm());
    }
    std::vector<ObjectSummary> objects;
    for (auto& [number, object] : by_number) {
        WayLength way;
        std::vector<Eigen::Vector3d> sizes;
        for (const ObjectBox* box : object.boxes) {
            way.add(box->stamp, box->center);
            sizes.push_back(box->size);
        }
        object.size = usual_size(sizes);
        object.path = way.so_far();
        objects.push_back(std::move(object));
    }
    return objects;
}

std::string objects_csv(const std::vector<ObjectSummary>& objects) {
    std::string text =
        "object,first_time,last_time,scans,points,length,width,height,path,fastest,"
        "first_x,first_y,first_z,last_x,last_y,last_z\n";
    for (const ObjectSummary& o : objects) {
        const ObjectBox &first = *o.boxes.front(), &last = *o.boxes.back();
        text += fmt::format(
            "{},{:.3f},{:.3f},{},{},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.3f},{:.3f},{:.3f},{:.3f},"
            "{:.3f},{:.3f}\n",
            o.object, first.stamp, last.stamp, o.boxes.size(), o.points, o.size.x(), o.size.y(),
            o.size.z(), o.path, o.fastest, first.center.x(), first.center.y(), first.center.z(),
            last.center.x(), last.center.y(), last.center.z());
    }
    return text;
}

std::string boxes_csv(const std::vector<ObjectBox>& boxes, const std::vector<std::string>& stems) {
    std::string text = "scan,time,object,x,y,z,length,width,height,yaw,vx,vy,points\n";
    for (const ObjectBox& box : boxes) {
        text += fmt::format(
            "{},{:.6f},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f},{:.3f},{:.3f},{}\n",
            stems[box.scan], box.stamp, box.object, box.center.x(), box.center.y(), box.center.z(),
            box.size.x(), box.size.y(), box.size.z(), box.yaw, box.velocity.x(), box.velocity.y(),
            box.points);
    }
    return text;
}

std::string objects_json(const std::vector<ObjectSummary>& objects,
                         const std::vector<std::string>& stems) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const ObjectSummary& object : objects) {
        nlohmann::ordered_json boxes = nlohmann::ordered_json::array();
        for (const ObjectBox* box : object.boxes) {
            boxes.push_back({{"scan", stems[box->scan]},
                             {"time", box->stamp},
                             {"center", array_of(rounded(box->center))},
                             {"size", array_of(rounded(box->size))},
                             {"yaw", rounded(box->yaw)},
                             {"velocity", array_of(rounded(box->velocity))},
                             {"points", box->points}});
        }
        all.push_back({{"object", object.object},
                       {"points", object.points},
                       {"size", array_of(rounded(object.size))},
                       {"boxes", std::move(boxes)}});
    }
    return nlohmann::ordered_json{{"objects", std::move(all)}}.dump(
               -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
           "\n";
}

std::string kitti_tracking(const std::vector<ObjectBox>& boxes,
                           std::span<const Pose> T_world_sensor) {
    std::string text;
    for (const ObjectBox& box : boxes) {
        const Pose T_sensor_world = T_world_sensor[box.scan].inverse();
        const Eigen::Vector3d bottom =
            T_sensor_world * (box.center - 0.5 * box.size.z() * Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d heading =
            T_sensor_world.linear() * Eigen::Vector3d(std::cos(box.yaw), std::sin(box.yaw), 0.0);
        // The camera's x axis is -y of the sensor, its z axis is x; a rotation of 0 looks along x.
        const float rotation =
            angle_of(static_cast<float>(-heading.x()), static_cast<float>(-heading.y()));
        text += fmt::format(
            "{} {} Misc -1 -1 -10 -1 -1 -1 -1 {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.4f}\n",
            box.scan, box.object, box.size.z(), box.size.y(), box.size.x(), -bottom.y(),
            -bottom.z(), bottom.x(), rotation);
    }
    return text;
}

std::string objects_page(std::vector<ObjectSummary> objects) {
    std::stable_sort(objects.begin(), objects.end(),
                     [](const auto& a, const auto& b) { return a.points > b.points; });
    double begin = std::numeric_limits<double>::infinity();  // [s]
    for (const ObjectSummary& o : objects) begin = std::min(begin, o.boxes.front()->stamp);
    std::string text = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>What moved</title>\n"
        "<style>body{{font:15px/1.4 system-ui,sans-serif;margin:2em}}table{{border-collapse:"
        "collapse}}td,th{{padding:.3em .8em;text-align:right;border-bottom:1px solid #ddd}}"
        "img{{width:96px;height:96px;display:block}}</style>\n<h1>What moved: {} objects</h1>\n"
        "<table><tr><th>object<th>picture<th>from [s]<th>to [s]<th>scans<th>points"
        "<th>length, width, height [m]<th>path [m]<th>fastest [m/s]</tr>\n",
        objects.size());
    for (const ObjectSummary& o : objects) {
        text += fmt::format(
            "<tr><td>{0}<td><img loading=\"lazy\" alt=\"points of object {0}\" "
            "src=\"pictures/{0:06}.png\"><td>{1:.1f}<td>{2:.1f}<td>{3}<td>{4}<td>{5:.1f}, {6:.1f}, "
            "{7:.1f}<td>{8:.1f}<td>{9:.1f}</tr>\n",
            o.object, o.boxes.front()->stamp - begin, o.boxes.back()->stamp - begin, o.boxes.size(),
            o.points, o.size.x(), o.size.y(), o.size.z(), o.path, o.fastest);
    }
    return text + "</table>\n</html>\n";
}

}  // namespace dynamic_filter::app
