// SPDX-License-Identifier: MIT
/// Finds the nearest hit of a ray with the static mesh and with moving copies of prototype meshes
/// (Embree: Wald et al., ACM Trans. Graphics 2014).
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/mesh.hpp"

struct RTCDeviceTy;  // Embree's; its header is included by caster.cpp alone
struct RTCSceneTy;

namespace dynamic_filter::sim {

/// A rigid part: its prototype, a factor of its reflectivity (clothes, paint), and the person or
/// vehicle to which it belongs.
struct Part {
    std::size_t prototype = 0;
    float brightness = 1.0F;
    std::uint16_t instance = 0;
    bool is_still = false;  ///< true: its kinds are those of its materials
};

/// The pose of a part at a given time, and its kind at that time.
struct Placement {
    Eigen::Affine3f T_world_part;
    Kind kind;
};

struct Hit {
    float range = 0.0F;   ///< [m] if the direction is a unit vector
    float cosine = 0.0F;  ///< |cos| of the angle between ray and surface normal
    float reflectivity = 0.0F;
    Kind kind = Kind::structure;
    std::uint16_t instance = 0;  ///< 0: static
    Gloss gloss = {};
    Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< unit vector, to either side
    bool found = false;
};

/// cast() may run in many threads at once, but place() and replace() may not.
class Caster {
public:
    Caster(const Mesh& still, std::vector<Mesh> prototypes, std::vector<Part> parts);
    ~Caster();
    Caster(const Caster&) = delete;
    Caster& operator=(const Caster&) = delete;

    /// Puts other parts in the place of all parts. The prototypes stay.
    void replace(std::vector<Part> parts);

    /// Moves the parts; `placements` is parallel to them.
    void place(const std::vector<Placement>& placements);

    /// `direction` is a unit vector; hits beyond `reach` [m] are not found.
    [[nodiscard]] Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                           float reach) const;

private:
    std::vector<Material> still_materials_;
    std::vector<Mesh> prototypes_;
    std::vector<Part> parts_;
    std::vector<Kind> kinds_;  // one per part
    // One per part: inverse transpose of its linear map.
    std::vector<Eigen::Matrix3f> normal_to_world_;
    RTCDeviceTy* device_ = nullptr;
    RTCSceneTy* scene_ = nullptr;
    RTCSceneTy* still_scene_ = nullptr;
    std::vector<RTCSceneTy*> prototype_scenes_;
};

}  // namespace dynamic_filter::sim
