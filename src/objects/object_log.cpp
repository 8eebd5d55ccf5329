// SPDX-License-Identifier: MIT
#include "objects/object_log.hpp"

#include <algorithm>

namespace dynamic_filter::app {

std::vector<std::uint32_t> moving_points(const Points& points, const Labels& labels) {
    std::vector<std::uint32_t> moving;
    for (std::uint32_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == Label::dynamic && is_measured(points[i])) moving.push_back(i);
    }
    return moving;
}

std::vector<Eigen::Vector3d> places_at(const Points& points, std::span<const std::uint32_t> indices,
                                       const Pose& T_world_sensor) {
    std::vector<Eigen::Vector3d> places;
    places.reserve(indices.size());
    for (const std::uint32_t i : indices) {
        places.emplace_back(T_world_sensor * points[i].cast<double>());
    }
    return places;
}

bool ObjectLog::is_settled(const Waiting& waiting) const {
    return std::all_of(waiting.objects.begin(), waiting.objects.end(), [&](auto object) {
        return object == kNoObject || tracker_.objects()[object].is_sure() ||
               !tracker_.may_go_on(object);
    });
}

std::uint32_t ObjectLog::number_of(std::uint32_t object) {
    if (object == kNoObject || !tracker_.objects()[object].is_sure()) return 0;
    const auto next = static_cast<std::uint32_t>(numbers_.size() + 1);
    return numbers_.try_emplace(object, next).first->second;
}

void ObjectLog::add(std::size_t scan, double stamp, std::vector<Eigen::Vector3d> places) {
    std::vector<std::uint32_t> objects = tracker_.follow(places, scan, stamp);
    waiting_.push_back({scan, std::move(places), std::move(objects)});
    while (!waiting_.empty() && is_settled(waiting_.front())) tell_next();
}

void ObjectLog::finish() {
    while (!waiting_.empty()) tell_next();
}

void ObjectLog::tell_next() {
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    KnownScan known{.scan = next.scan};
    std::map<std::uint32_t, std::vector<Eigen::Vector3d>> places;  // by the tracker's numbers
    for (std::size_t i = 0; i < next.places.size(); ++i) {
        known.numbers.push_back(number_of(next.objects[i]));
        if (known.numbers.back() != 0) places[next.objects[i]].push_back(next.places[i]);
    }
    for (auto& [object, of_object] : places) {
        const Sighting& sighting = tracker_.sighting(object, next.scan);
        ObjectBox box = box_around(of_object, sighting.heading);
        box.object = numbers_.at(object);
        box.scan = next.scan;
        box.stamp = sighting.stamp;
        box.velocity = sighting.velocity;
        known.objects.push_back({box, std::move(of_object)});
        tracker_.forget(object, next.scan);
    }
    tell_(std::move(known));
}

}  // namespace dynamic_filter::app
