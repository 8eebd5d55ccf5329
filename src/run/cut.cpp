// SPDX-License-Identifier: MIT
#include "run/cut.hpp"

#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

/// Tells quickly of most points that they are far from a tile.
class FarFromTile {
public:
    FarFromTile(const Tile& tile, const Pose& T_world_sensor, double edge)
        : is_whole_(tile.is_whole), T_(T_world_sensor.matrix().topRows<2>()) {
        // Half a cell more than the cells around it, because the cells of points decide.
        const double side = cells_of(tile.level) * edge, margin = 1.5 * edge;
        const Eigen::Vector2d corner = side * Eigen::Vector2d(tile.x, tile.y);
        area_ = {corner - Eigen::Vector2d::Constant(margin),
                 corner + Eigen::Vector2d::Constant(side + margin)};
    }
    bool operator()(const Point& point) const {
        if (is_whole_) return false;
        return !area_.contains(T_.leftCols<3>() * point.cast<double>() + T_.col(3));
    }

private:
    bool is_whole_;
    Eigen::Matrix<double, 2, 4> T_;
    Eigen::AlignedBox2d area_;
};

bool is_around(const Tile& tile, const PlaneCell& cell) {
    const std::int32_t side = cells_of(tile.level);
    const auto within = [&](std::int32_t at, std::int32_t number) {
        return at >= number * side - 1 && at <= (number + 1) * side;
    };
    return within(cell.x, tile.x) && within(cell.y, tile.y);
}

}  // namespace

Cut cut_of(const io::FullScan& scan, const Tile& tile, double edge) {
    const FarFromTile is_far(tile, scan.T_world_sensor, edge);
    Cut cut;
    for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
        const Point& point = scan.points[i];
        if (!is_measured(point) || is_far(point)) continue;
        const Eigen::Vector3d world = scan.T_world_sensor * point.cast<double>();
        if (!has_cell(world)) continue;
        const PlaneCell cell = cell_at(world, edge);
        if (!tile.is_whole && !is_around(tile, cell)) continue;
        cut.indices.push_back(i);
        cut.points.push_back(point);
        cut.inside.push_back(tile.is_whole || tile_at(cell, tile.level) == tile);
        if (!scan.truth.empty()) cut.truth.push_back(scan.truth[i]);
    }
    return cut;
}

Labels labels_of(const Cut& cut, const Labels& of_scan) {
    Labels labels;
    labels.reserve(cut.indices.size());
    for (const std::uint32_t i : cut.indices) labels.push_back(of_scan[i]);
    return labels;
}

eval::LabelledScan labelled_inside(const Cut& cut, const Pose& T_world_sensor,
                                   const Eigen::Vector3d& origin) {
    eval::LabelledScan scan{shifted_world(cut.points, T_world_sensor, origin), cut.truth, {}};
    for (std::size_t i = 0; i < scan.truth.size(); ++i) {
        if (!cut.inside[i]) scan.truth[i] = Label::unknown;
    }
    return scan;
}

}  // namespace dynamic_filter::app
