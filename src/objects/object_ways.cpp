// SPDX-License-Identifier: MIT
#include "objects/object_ways.hpp"

#include <algorithm>
#include <utility>

namespace dynamic_filter::app {

namespace {

constexpr std::size_t kMostPlaces = 128;

/// Every second one, from the first on.
void keep_every_second(std::vector<ObjectWay::Place>& places) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < places.size(); i += 2) places[kept++] = places[i];
    places.resize(kept);
}

Eigen::Vector3d usual_size_at(const std::vector<ObjectWay::Place>& places) {
    std::vector<Eigen::Vector3d> sizes;
    for (const ObjectWay::Place& place : places) sizes.push_back(place.size);
    return usual_size(sizes);
}

}  // namespace

void ObjectWays::add(const KnownScan& scan) {
    for (const SeenObject& seen : scan.objects) {
        const ObjectBox& box = seen.box;
        Growing& growing = growing_[box.object];
        ObjectWay& way = growing.way;
        if (growing.scans == 0) way.object = box.object, way.first = box.scan;
        way.last = box.scan;
        way.points += box.points;
        way.fastest = std::max(way.fastest, box.velocity.norm());
        growing.length.add(box.stamp, box.center);
        if (box.points > growing.most) growing.most = box.points, way.nearest = box.scan;
        if (growing.scans++ % growing.stride != 0) continue;
        way.places.push_back({box.scan, box.center, box.size});
        if (way.places.size() < kMostPlaces) continue;
        keep_every_second(way.places);
        growing.stride *= 2;
    }
}

std::vector<ObjectWay> ObjectWays::take(std::size_t most) {
    std::vector<ObjectWay> ways;
    for (auto& [number, growing] : std::exchange(growing_, {})) {
        growing.way.path = growing.length.so_far();
        growing.way.size = usual_size_at(growing.way.places);
        ways.push_back(std::move(growing.way));
    }
    std::stable_sort(ways.begin(), ways.end(),
                     [](const auto& a, const auto& b) { return a.points > b.points; });
    if (ways.size() > most) ways.resize(most);
    std::sort(ways.begin(), ways.end(),
              [](const auto& a, const auto& b) { return a.object < b.object; });
    return ways;
}

}  // namespace dynamic_filter::app
