// SPDX-License-Identifier: MIT
#include "sim/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/portable.hpp"
#include "sim/prototypes.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Affine3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

std::size_t index_of(Prototype prototype) { return static_cast<std::size_t>(prototype); }

/// A frame at a point of the ground plane; its x axis looks along `heading`.
Affine3d standing_at(const Vector2d& p, double z, const Vector2d& heading) {
    Affine3d T = Affine3d::Identity();
    T.linear() << heading.x(), -heading.y(), 0.0,  //
        heading.y(), heading.x(), 0.0,             //
        0.0, 0.0, 1.0;
    T.translation() = Vector3d(p.x(), p.y(), z);
    return T;
}

Affine3d joint(const Vector3d& at, double angle) {
    const SinCos a = portable_sincos(angle);
    Affine3d T = Affine3d::Identity();
    T.linear() << a.cos, 0.0, a.sin, 0.0, 1.0, 0.0, -a.sin, 0.0, a.cos;  // rotation about y
    T.translation() = at;
    return T;
}

/// A frame for a limb that hangs along -z in its own frame: from `from` to `to`, in the x-z plane.
Affine3d pointing(const Vector3d& from, const Vector3d& to) {
    const Vector3d d = (to - from).normalized();
    Affine3d T = Affine3d::Identity();
    T.linear() << -d.z(), 0.0, -d.x(), 0.0, 1.0, 0.0, d.x(), 0.0, -d.z();
    T.translation() = from;
    return T;
}

/// Places the legs of a cyclist from the angle of the crank; the knees follow from the law of
/// cosines.
void place_pedalling(const Affine3d& T, double crank, Placements& out) {
    for (const double side : {1.0, -1.0}) {
        const SinCos a = portable_sincos(crank + (side > 0.0 ? 0.0 : std::numbers::pi));
        const Vector3d hip(-0.15, 0.1 * side, 0.97);
        const Vector3d pedal(-0.05 + 0.17 * a.sin, 0.1 * side, 0.36 + 0.17 * a.cos);
        const Vector3d d = pedal - hip;
        const double reach = std::min(d.norm(), 0.999 * (thigh_length + shin_length));
        const double along =
            (reach * reach + thigh_length * thigh_length - shin_length * shin_length) /
            (2.0 * reach);
        const double bend = std::sqrt(std::max(0.0, thigh_length * thigh_length - along * along));
        const Vector3d axis = d.normalized();
        const Vector3d knee = hip + along * axis + bend * Vector3d(-axis.z(), 0.0, axis.x());
        out.push_back({(T * pointing(hip, knee)).cast<float>(), Kind::vehicle});
        out.push_back({(T * pointing(knee, pedal)).cast<float>(), Kind::vehicle});
    }
}

}  // namespace

Vector2d half_footprint(VehicleKind kind) {
    switch (kind) {
        case VehicleKind::car:
            return {2.15, 0.9};
        case VehicleKind::van:
            return {2.7, 1.0};
        case VehicleKind::bus:
            return {6.0, 1.25};
        case VehicleKind::wagon:
            return {wagon_half_length, wagon_half_width};
        case VehicleKind::gate:
            return gate_size / 2.0;
        case VehicleKind::load:
            return load_size / 2.0;
        case VehicleKind::cyclist:
            break;
    }
    return {0.85, 0.3};
}

std::vector<Part> walker_parts(std::size_t index, bool luggage) {
    const auto shade = [&](std::uint64_t use) {
        return static_cast<float>(0.5 + 0.9 * unit(hash(0xc107, index, use)));
    };
    const bool pack = unit(hash(0xba6, index)) < 0.3;
    const std::size_t torso = index_of(pack ? Prototype::torso_with_pack : Prototype::torso);
    const std::size_t leg = index_of(Prototype::leg), arm = index_of(Prototype::arm);
    std::vector<Part> parts = {
        {torso, shade(0)}, {leg, shade(1)}, {leg, shade(1)}, {arm, shade(0)}, {arm, shade(0)}};
    if (luggage) parts.push_back({index_of(Prototype::suitcase), shade(2)});
    return parts;
}

std::vector<Part> vehicle_parts(const Vehicle& vehicle) {
    const float b = vehicle.brightness;
    switch (vehicle.kind) {
        case VehicleKind::car:
            return {{index_of(Prototype::car), b}};
        case VehicleKind::van:
            return {{index_of(Prototype::van), b}};
        case VehicleKind::bus:
            return {{index_of(Prototype::bus), b}};
        case VehicleKind::wagon:
            return {{index_of(Prototype::wagon), b},
                    {index_of(Prototype::fore_doors), 0.7F * b},
                    {index_of(Prototype::aft_doors), 0.7F * b}};
        case VehicleKind::gate:
            return {{index_of(Prototype::gate), b}};
        case VehicleKind::load:
            return {{index_of(Prototype::load), b}};
        case VehicleKind::cyclist:
            break;
    }
    const std::size_t thigh = index_of(Prototype::thigh), shin = index_of(Prototype::shin);
    return {{index_of(Prototype::bicycle), b}, {thigh, b}, {shin, b}, {thigh, b}, {shin, b}};
}

void place_walker(const Walker& walker, const Stride& stride, double ground, Placements& out) {
    const double tall = walker.height / 1.75;
    const double hip = leg_length * 1.75;
    const double step =
        static_cast<double>(stride.swing) * portable_sincos(static_cast<double>(stride.phase)).sin;
    // With the legs apart, the feet would not reach the ground, so the hips are lowered.
    const double sink = hip * (1.0 - portable_sincos(step).cos);
    const Affine3d T = standing_at(stride.position.cast<double>(), ground - tall * sink,
                                   stride.heading.cast<double>()) *
                       Eigen::Scaling(tall);
    constexpr float slowest_walk = 0.2F;  // [m/s]
    const Kind kind = stride.speed < slowest_walk ? Kind::standing : Kind::walking;
    out.push_back({T.cast<float>(), kind});
    out.push_back({(T * joint({0.0, 0.09, hip}, -step)).cast<float>(), kind});
    out.push_back({(T * joint({0.0, -0.09, hip}, step)).cast<float>(), kind});
    out.push_back({(T * joint({0.0, 0.23, 1.40}, 0.9 * step)).cast<float>(), kind});
    out.push_back({(T * joint({0.0, -0.23, 1.40}, -0.9 * step)).cast<float>(), kind});
    if (walker.luggage) {  // the suitcase has the same size for all people
        const Affine3d beside =
            standing_at(stride.position.cast<double>(), ground, stride.heading.cast<double>()) *
            Eigen::Translation3d(-0.3, -0.35, 0.0);
        out.push_back({beside.cast<float>(), kind});
    }
}

void place_vehicle(const Vehicle& vehicle, double t, Placements& out) {
    const double s = travelled(vehicle.ride, t);
    const PathPoint p = at(vehicle.ride.path, s);
    const Affine3d T = standing_at(p.position, 0.0, p.direction);
    out.push_back({T.cast<float>(), Kind::vehicle});
    constexpr double metres_per_turn = 5.0;
    if (vehicle.kind == VehicleKind::cyclist) {
        place_pedalling(T, 2.0 * std::numbers::pi * s / metres_per_turn, out);
    }
    if (vehicle.kind == VehicleKind::wagon) {
        const double slide = door_leaf * door_opening(vehicle.ride, t);
        for (const double way : {slide, -slide}) {
            out.push_back({(T * Eigen::Translation3d(way, 0.0, 0.0)).cast<float>(), Kind::vehicle});
        }
    }
}

double door_opening(const Ride& ride, double t) {
    constexpr double rest = 1.0, slide = 1.5;  // [s] closed while the train stands; [s] to open
    const double came = halts_at(ride), leaves = came + ride.stop_time;
    return std::clamp(std::min(t - came - rest, leaves - rest - t) / slide, 0.0, 1.0);
}

void add_movers(const Vehicle& vehicle, double t, std::vector<Mover>& out) {
    if (vehicle.kind == VehicleKind::wagon) return;
    const Vector2d half = half_footprint(vehicle.kind);
    const double s = travelled(vehicle.ride, t);
    const double speed = (travelled(vehicle.ride, t + 0.05) - s) / 0.05;
    const PathPoint p = at(vehicle.ride.path, s);
    const double room = half.x() - half.y();
    const int discs = std::max(1, static_cast<int>(std::ceil(2.0 * room / half.y())));
    for (int i = 0; i <= discs; ++i) {
        const double along = -room + 2.0 * room * i / discs;
        out.push_back({p.position + along * p.direction, speed * p.direction, half.y()});
    }
}

}  // namespace dynamic_filter::sim
