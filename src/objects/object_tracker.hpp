// SPDX-License-Identifier: MIT
/// Which points of successive scans are the same moving object.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace dynamic_filter::app {

/// Stands for "no object" in place of the number of one.
constexpr std::uint32_t kNoObject = UINT32_MAX;

/// What one scan saw of an object.
struct Sighting {
    std::size_t scan = 0;
    double stamp = 0.0;       ///< [s]
    Eigen::AlignedBox3d box;  ///< [m] around its points in the world
    std::size_t points = 0;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s] by then
    double heading = 0.0;  ///< [rad] where it went when it last went on
};

struct MovingObject {
    std::vector<Sighting> sightings;  ///< in the order of the scans, unless forgotten
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s] at the last one
    Eigen::Vector3d largest = Eigen::Vector3d::Zero();   ///< [m] greatest extent of a box
    std::size_t points = 0;                              ///< in all scans
    bool went = false;                                   ///< it has a heading
    bool has_ended = false;  ///< it turned out to be a side of an older object

    /// True if it was seen often enough not to be a stray echo.
    [[nodiscard]] bool is_sure() const { return sightings.size() >= 3 && points >= 20; }
};

/// Follows objects from scan to scan. In each scan, the points that move form pieces (pieces.hpp).
/// An object goes on as the piece that is nearest to where it should be by now. A piece that
/// several objects go on as, and that is larger than each of them, is divided among them. Pieces
/// that no object goes on as are new objects. Two objects that stay abreast while they drive are
/// the sides of one, seen through its windows: the older one goes on as both. An object that is not
/// seen for two seconds has ended. Single caller.
class ObjectTracker {
public:
    /// The object of each place [m, world], which are those of the points that move in a scan;
    /// kNoObject for pieces of less than five points.
    std::vector<std::uint32_t> follow(std::span<const Eigen::Vector3d> places, std::size_t scan,
                                      double stamp);
    /// By their numbers.
    [[nodiscard]] const std::vector<MovingObject>& objects() const { return objects_; }
    /// How this scan saw an object. Both must be known, and not forgotten.
    [[nodiscard]] const Sighting& sighting(std::uint32_t object, std::size_t scan) const;
    /// Forgets the sightings up to a scan, but for the newest few.
    void forget(std::uint32_t object, std::size_t scan);
    /// False: it has ended, and no later scan goes on with it.
    [[nodiscard]] bool may_go_on(std::uint32_t object) const;

private:
    void note(std::span<const Eigen::Vector3d> places, const std::vector<std::uint32_t>& owners,
              std::size_t scan);
    void unite(const std::map<std::uint32_t, Sighting>& seen);

    std::vector<MovingObject> objects_;
    std::vector<std::uint32_t> open_;  // objects that may go on
    double stamp_ = 0.0;               // [s] of the newest scan
};

}  // namespace dynamic_filter::app
