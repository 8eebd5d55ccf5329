// SPDX-License-Identifier: MIT
/// Nearest hit of a ray in a still mesh and in moving copies of prototype meshes (Embree: Wald et
/// al., ACM Trans. Graphics 2014).
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <vector>

#include "mesh.hpp"

namespace dynamic_filter::sim {

/// A moving rigid part: which prototype it copies, a factor on its reflectivity (clothes, paint),
/// and the person or vehicle it belongs to.
struct Part {
    std::size_t prototype = 0;
    float brightness = 1.0F;
    std::uint16_t instance = 0;
};

/// Where a part is at a moment, and what it counts as then.
struct Placement {
    Eigen::Affine3f T_world_part;
    Kind kind;
};

struct Hit {
    float range = 0.0F;   ///< [m] in units of the direction's length
    float cosine = 0.0F;  ///< |cos| of the angle between ray and surface normal
    float reflectivity = 0.0F;
    Kind kind = Kind::structure;
    std::uint16_t instance = 0;  ///< 0: of what stands still
    bool found = false;
};

/// cast() may run in many threads at once, place() may not.
class Caster {
public:
    Caster(const Mesh& still, std::vector<Mesh> prototypes, std::vector<Part> parts);
    ~Caster();
    Caster(const Caster&) = delete;
    Caster& operator=(const Caster&) = delete;

    /// `placements` is parallel to the parts.
    void place(const std::vector<Placement>& placements);

    /// `direction` is a unit vector; hits beyond `reach` [m] are not found.
    [[nodiscard]] Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                           float reach) const;

private:
    std::vector<Material> still_materials_;
    std::vector<Mesh> prototypes_;
    std::vector<Part> parts_;
    std::vector<Kind> kinds_;                       // of the parts
    std::vector<Eigen::Matrix3f> normal_to_world_;  // inverse transpose of the parts' linear maps
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    RTCScene still_scene_ = nullptr;
    std::vector<RTCScene> prototype_scenes_;
};

}  // namespace dynamic_filter::sim
