// SPDX-License-Identifier: MIT
/// Which scans suffice as evidence of free space.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

namespace dynamic_filter::app {

/// Beams are followed so far only [m]; farther away they are too sparse to tell of a surface.
constexpr float kFarthestLook = 30.0F;

/// Chooses scans that are half a metre or two seconds apart.
class LookChooser {
public:
    /// Asked for each scan once, in the order of their stamps [s]; `place` of the sensor in any
    /// frame that is the same for all [m].
    bool chooses(const Eigen::Vector3d& place, double stamp) {
        constexpr double kApart = 0.5, kAgain = 2.0;
        if (last_ && (place - last_->place).norm() < kApart &&
            std::abs(stamp - last_->stamp) < kAgain) {
            return false;
        }
        last_ = {place, stamp};
        return true;
    }

private:
    struct Last {
        Eigen::Vector3d place;
        double stamp;
    };
    std::optional<Last> last_;
};

}  // namespace dynamic_filter::app
