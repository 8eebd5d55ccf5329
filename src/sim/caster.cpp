// SPDX-License-Identifier: MIT
#include "sim/caster.hpp"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace dynamic_filter::sim {
namespace {

void attach_mesh(RTCDevice device, RTCScene scene, const Mesh& mesh) {
    if (mesh.triangles.empty()) return;
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Vector3i) == 12);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             12, mesh.vertices.size());
    std::memcpy(vertices, mesh.vertices.front().data(), 12 * mesh.vertices.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              12, mesh.triangles.size());
    std::memcpy(triangles, mesh.triangles.front().data(), 12 * mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

void attach_copy(RTCDevice device, RTCScene scene, RTCScene of) {
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, of);
    rtcCommitGeometry(instance);
    rtcAttachGeometry(scene, instance);
    rtcReleaseGeometry(instance);
}

RTCScene new_scene(RTCDevice device) {
    const RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
}

}  // namespace

Caster::Caster(const Mesh& still, std::vector<Mesh> prototypes, std::vector<Part> parts)
    : still_materials_(still.materials),
      prototypes_(std::move(prototypes)),
      device_(rtcNewDevice(nullptr)) {
    // The static objects are a scene of their own, so that it is not built again when objects move.
    still_scene_ = new_scene(device_);
    attach_mesh(device_, still_scene_, still);
    rtcCommitScene(still_scene_);
    for (const Mesh& mesh : prototypes_) {
        prototype_scenes_.push_back(new_scene(device_));
        attach_mesh(device_, prototype_scenes_.back(), mesh);
        rtcCommitScene(prototype_scenes_.back());
    }
    replace(std::move(parts));
}

void Caster::replace(std::vector<Part> parts) {
    parts_ = std::move(parts);
    kinds_.assign(parts_.size(), Kind::structure);
    normal_to_world_.assign(parts_.size(), Eigen::Matrix3f::Identity());
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    scene_ = new_scene(device_);
    attach_copy(device_, scene_, still_scene_);  // gets id 0; the parts get 1, 2, ...
    for (const Part& part : parts_) {
        attach_copy(device_, scene_, prototype_scenes_[part.prototype]);
    }
    rtcCommitScene(scene_);
}

Caster::~Caster() {
    rtcReleaseScene(scene_);
    rtcReleaseScene(still_scene_);
    for (const RTCScene scene : prototype_scenes_) rtcReleaseScene(scene);
    rtcReleaseDevice(device_);
}

void Caster::place(const std::vector<Placement>& placements) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Eigen::Affine3f& T = placements[i].T_world_part;
        kinds_[i] = placements[i].kind;
        normal_to_world_[i] = T.linear().inverse().transpose();
        const RTCGeometry instance = rtcGetGeometry(scene_, static_cast<unsigned>(i + 1));
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, T.matrix().data());
        rtcCommitGeometry(instance);
    }
    rtcCommitScene(scene_);
}

Hit Caster::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                 float reach) const {
    RTCRayHit query{};
    query.ray.org_x = origin.x();
    query.ray.org_y = origin.y();
    query.ray.org_z = origin.z();
    query.ray.dir_x = direction.x();
    query.ray.dir_y = direction.y();
    query.ray.dir_z = direction.z();
    query.ray.tfar = reach;
    query.ray.mask = std::numeric_limits<unsigned>::max();
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR < 4
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
#else
    rtcIntersect1(scene_, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

    Hit hit{.range = query.ray.tfar, .found = true};
    Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    if (query.hit.instID[0] == 0) {
        hit.reflectivity = still_materials_[query.hit.primID].reflectivity;
        hit.kind = still_materials_[query.hit.primID].kind;
        hit.gloss = still_materials_[query.hit.primID].gloss;
    } else {
        const std::size_t i = query.hit.instID[0] - 1;
        normal = normal_to_world_[i] * normal;
        const Mesh& prototype = prototypes_[parts_[i].prototype];
        const Material& material = prototype.materials[query.hit.primID];
        hit.reflectivity = material.reflectivity * parts_[i].brightness;
        hit.kind = parts_[i].is_still ? material.kind : kinds_[i];
        hit.instance = parts_[i].instance;
    }
    hit.normal = normal.normalized();
    hit.cosine = std::abs(hit.normal.dot(direction));
    return hit;
}

}  // namespace dynamic_filter::sim
