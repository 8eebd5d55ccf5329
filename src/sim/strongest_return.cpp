// SPDX-License-Identifier: MIT
#include "sim/strongest_return.hpp"

namespace dynamic_filter::sim {
namespace {

constexpr int most_surfaces = 4;         // that one beam meets
constexpr float glare_cosine = 0.9945F;  // 6 degrees: panes are not exactly flat
constexpr float glare = 0.5F;            // reflectivity of a pane that is seen head-on

float reflected_share(const Hit& surface) {
    const float grazing = 1.0F - surface.cosine, squared = grazing * grazing;
    return surface.gloss.reflects + (1.0F - surface.gloss.reflects) * squared * squared * grazing;
}

/// Received power up to a constant (Lambert).
float power(const Hit& hit) {
    return hit.found ? hit.reflectivity * hit.cosine / (hit.range * hit.range) : 0.0F;
}

Hit follow(const Caster& caster, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
           float reach, int surfaces) {
    Hit surface = caster.cast(origin, direction, reach);
    const bool is_smooth = surface.gloss.reflects > 0.0F || surface.gloss.transmits > 0.0F;
    if (!surface.found || !is_smooth || surfaces == 0) return surface;

    const Eigen::Vector3f at = origin + surface.range * direction;
    // The light passes the surface on its way out and on its way back.
    const auto beyond = [&](const Eigen::Vector3f& onward, float share) {
        constexpr float off = 1e-3F;  // [m] so that the surface is not met again
        Hit hit = follow(caster, at + off * onward, onward, reach - surface.range, surfaces - 1);
        hit.range += surface.range + off;
        hit.reflectivity *= share * share;
        return hit;
    };
    const float reflected = reflected_share(surface);
    Hit mirrored =
        beyond(direction - 2.0F * direction.dot(surface.normal) * surface.normal, reflected);
    mirrored.kind = Kind::reflection;
    if (surface.cosine > glare_cosine) surface.reflectivity += glare;
    Hit strongest = power(mirrored) > power(surface) ? mirrored : surface;
    if (surface.gloss.transmits > 0.0F) {
        const Hit behind = beyond(direction, (1.0F - reflected) * surface.gloss.transmits);
        if (power(behind) > power(strongest)) strongest = behind;
    }
    return strongest;
}

}  // namespace

Hit strongest_return(const Caster& caster, const Eigen::Vector3f& origin,
                     const Eigen::Vector3f& direction, float reach) {
    return follow(caster, origin, direction, reach, most_surfaces);
}

}  // namespace dynamic_filter::sim
