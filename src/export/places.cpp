// SPDX-License-Identifier: MIT
#include "export/places.hpp"

namespace dynamic_filter::app {

std::vector<Eigen::Vector3d> places_of(const io::Cloud& cloud) {
    std::vector<Eigen::Vector3d> places(cloud.size());
    for (const char axis : {'x', 'y', 'z'}) {
        const auto values = io::values(cloud, *cloud.find(std::string(1, axis)));
        for (std::size_t i = 0; i < places.size(); ++i) places[i][axis - 'x'] = values[i];
    }
    return places;
}

io::Cloud without_records(const io::Cloud& cloud) {
    io::Cloud empty;
    empty.fields = cloud.fields;
    empty.point_bytes = cloud.point_bytes;
    empty.viewpoint = cloud.viewpoint;
    empty.crs = cloud.crs;
    empty.gps_time_is_adjusted = cloud.gps_time_is_adjusted;
    return empty;
}

}  // namespace dynamic_filter::app
