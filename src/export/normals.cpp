// SPDX-License-Identifier: MIT
#include "export/normals.hpp"

#include <cstring>
#include <span>

#include "dynamic_filter/parallel.hpp"
#include "geometry/neighbor_grid.hpp"
#include "geometry/principal_axes.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

std::array<std::string, 3> normal_names(const std::filesystem::path& file) {
    if (file.extension() == ".ply") return {"nx", "ny", "nz"};
    return {"normal_x", "normal_y", "normal_z"};
}

namespace {

/// Where the three components lie in a record.
using Offsets = std::array<std::size_t, 3>;

Offsets offsets_of(const io::Cloud& cloud, const std::array<std::string, 3>& names) {
    Offsets offsets{};
    for (std::size_t axis = 0; axis < 3; ++axis) offsets[axis] = cloud.find(names[axis])->offset;
    return offsets;
}

Eigen::Vector3f vector_in(const std::byte* record, const Offsets& offsets) {
    Eigen::Vector3f vector;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::memcpy(vector.data() + axis, record + offsets[axis], sizeof(float));
    }
    return vector;
}

void put_vector(std::byte* record, const Offsets& offsets, const Eigen::Vector3f& vector) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::memcpy(record + offsets[axis], vector.data() + axis, sizeof(float));
    }
}

}  // namespace

void turn_normals(io::Cloud& cloud, const std::array<std::string, 3>& names,
                  const Eigen::Matrix3d& turn) {
    const Offsets offsets = offsets_of(cloud, names);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        std::byte* const record = cloud.data.data() + i * cloud.point_bytes;
        const Eigen::Vector3d turned = turn * vector_in(record, offsets).cast<double>();
        put_vector(record, offsets, turned.stableNormalized().cast<float>());
    }
}

void fit_normals(io::Cloud& cloud, const std::array<std::string, 3>& names, double radius) {
    constexpr std::size_t kNeighbors = 20, kGrain = 256;
    const Points points = positions_from(cloud, origin_of(cloud));
    const NeighborGrid grid(points, static_cast<float>(radius));
    const Offsets offsets = offsets_of(cloud, names);
    parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbor> neighbors;
        for (std::size_t i = begin; i < end; ++i) {
            grid.nearest(points[i], kNeighbors, neighbors);
            Moments moments{.origin = points[i]};
            for (const Neighbor& neighbor : neighbors) moments.add(grid.point(neighbor.index));
            Eigen::Vector3f normal =
                smallest_axis(moments).value_or(Eigen::Vector3d::Zero()).cast<float>();
            std::byte* const record = cloud.data.data() + i * cloud.point_bytes;
            if (normal.dot(vector_in(record, offsets)) < 0.0F) normal = -normal;
            put_vector(record, offsets, normal);
        }
    });
}

}  // namespace dynamic_filter::app
