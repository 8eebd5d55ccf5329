// SPDX-License-Identifier: MIT
/// Boxes of moving objects, and the files that hold them.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// A box around what one scan saw of an object. Its x axis points where the object goes; length is
/// along it.
struct ObjectBox {
    std::uint32_t object = 0;  ///< from 1
    std::size_t scan = 0;
    double stamp = 0.0;                                  ///< [s]
    Eigen::Vector3d center = Eigen::Vector3d::Zero();    ///< [m] in the world
    Eigen::Vector3d size = Eigen::Vector3d::Zero();      ///< [m] length, width, height
    double yaw = 0.0;                                    ///< [rad] of its x axis in the world
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
    std::size_t points = 0;
};

/// The way of a middle in the plane, by steps of at least a second, because the middle of what is
/// seen shifts from scan to scan.
class WayLength {
public:
    /// `stamp` [s], in their order; `center` [m].
    void add(double stamp, const Eigen::Vector3d& center);
    [[nodiscard]] double so_far() const;  ///< [m]

private:
    std::optional<double> since_;  // [s]
    Eigen::Vector3d from_ = Eigen::Vector3d::Zero(), last_ = Eigen::Vector3d::Zero();
    double way_ = 0.0;
};

/// Around places [m, world], along a direction of the plane.
ObjectBox box_around(std::span<const Eigen::Vector3d> places, double yaw);

/// [m] The size that nine tenths of these keep to, axis by axis. `sizes` must not be empty.
Eigen::Vector3d usual_size(std::span<const Eigen::Vector3d> sizes);

/// An object over all its scans.
struct ObjectSummary {
    std::uint32_t object = 0;
    std::vector<const ObjectBox*> boxes;             ///< in the order of the scans
    Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< [m] that nine tenths of its boxes keep to
    double path = 0.0;                               ///< [m] way that its middle went
    double fastest = 0.0;                            ///< [m/s]
    std::size_t points = 0;
};

/// By their numbers. Point to the boxes, which are in the order of the scans.
std::vector<ObjectSummary> summaries_of(const std::vector<ObjectBox>& boxes);

/// A row for each object, and a row for each box. The first line names the columns.
std::string objects_csv(const std::vector<ObjectSummary>& objects);
/// `stems`: names of the scans.
std::string boxes_csv(const std::vector<ObjectBox>& boxes, const std::vector<std::string>& stems);
/// {"objects": [{"object", "points", "size", "boxes": [{"scan", "time", "center", "size", "yaw",
/// "velocity", "points"}]}]}
std::string objects_json(const std::vector<ObjectSummary>& objects,
                         const std::vector<std::string>& stems);
/// Lines of KITTI's tracking benchmark. It has no frame of a LiDAR, so boxes are in one whose z
/// axis is the sensor's x axis and whose y axis points down; what needs a camera is -1, and the
/// type is Misc. `T_world_sensor` by scan.
std::string kitti_tracking(const std::vector<ObjectBox>& boxes,
                           std::span<const Pose> T_world_sensor);
/// A page with the table, those with most points first, and the pictures, pictures/NUMBER.png.
/// Times are since the first of them was seen.
std::string objects_page(std::vector<ObjectSummary> objects);

}  // namespace dynamic_filter::app
