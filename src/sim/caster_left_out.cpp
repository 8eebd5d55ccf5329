// SPDX-License-Identifier: MIT
/// In place of caster.cpp where the program is built without Embree.
#include "dynamic_filter/error.hpp"
#include "sim/caster.hpp"

namespace dynamic_filter::sim {

Caster::Caster(const Mesh& /*still*/, std::vector<Mesh> /*prototypes*/,
               std::vector<Part> /*parts*/) {
    throw ConfigError(
        "the simulator was left out when this program was built; everything else works. To have "
        "it, install Embree (libembree-dev on Debian and Ubuntu) and build with "
        "-DDYNAMIC_FILTER_SIMULATOR=ON");
}

Caster::~Caster() = default;

void Caster::replace(std::vector<Part> /*parts*/) {}

void Caster::place(const std::vector<Placement>& /*placements*/) {}

Hit Caster::cast(const Eigen::Vector3f& /*origin*/, const Eigen::Vector3f& /*direction*/,
                 float /*reach*/) const {
    return {};
}

}  // namespace dynamic_filter::sim
