// SPDX-License-Identifier: MIT
/// What drives show around places along their way.
#pragma once

#include <span>
#include <vector>

#include "check/place_signature.hpp"
#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// A scan of one of the recordings.
struct ScanOfDrive {
    std::size_t drive = 0, scan = 0;
};

/// What scans around a place show, relative to the place and with the axes of the world.
struct Local {
    ScanOfDrive place;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();  // [m] world
    Points cloud;
    PlaceSignature signature{};
};

/// Places after each 5 m of the way, or farther apart, so that all drives have `most` at most.
/// Reads five scans for each. Runs in parallel.
std::vector<Local> locals_of(std::span<const Recording* const> drives, std::size_t most);

}  // namespace dynamic_filter::io
