// SPDX-License-Identifier: MIT
#include "sim/city.hpp"
#include "sim/props.hpp"

namespace dynamic_filter::sim::city {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr float plaster = 0.5F, wood = 0.3F, concrete = 0.4F, asphalt = 0.2F, stones = 0.3F;
constexpr Material bar(0.4F, Kind::thin);

void box(Mesh& mesh, const Vector3d& low, const Vector3d& high, Material material) {
    add_box(mesh, Affine3d::Identity(), {low, high}, material);
}

/// The ground of a block and its half of the streets around.
Mesh slab_mesh() {
    Mesh mesh;
    const double width = pitch[0], depth = pitch[1];
    add_quad(mesh, {0, 0, 0}, {width, 0, 0}, {0, depth, 0}, {asphalt, Kind::ground});
    const double x = width - 2.0 * kerb, y = depth - 2.0 * kerb;
    add_quad(mesh, {kerb, kerb, pavement}, {x, 0, 0}, {0, y, 0}, {stones, Kind::ground});
    const Material edge(concrete, Kind::ground);
    for (const double far : {0.0, y})
        add_quad(mesh, {kerb, kerb + far, 0}, {x, 0, 0}, {0, 0, pavement}, edge);
    for (const double far : {0.0, x})
        add_quad(mesh, {kerb + far, kerb, 0}, {0, y, 0}, {0, 0, pavement}, edge);
    return mesh;
}

/// A house with closed sides and a roof. Its outer bays are walls, so that any house may stand at a
/// corner of a block.
Mesh house_mesh(int bays, std::uint64_t seed) {
    constexpr double depth = 7.0, end_wall = 0.2;
    Random random{hash(seed, 0x40)};
    Facade facade{.spot = {},
                  .bays = {},
                  .bay_width = bay_width,
                  .upper_floors = 1 + random.below(4),
                  .seed = random.bits()};
    const Bay kinds[] = {Bay::wall, Bay::shop, Bay::recess, Bay::wall, Bay::shop, Bay::door};
    for (int i = 0; i < bays; ++i) {
        facade.bays.push_back(i == 0 || i + 1 == bays ? Bay::wall : kinds[random.below(6)]);
    }
    Scene scene;
    add_facade(scene, facade);
    const double length = bays * bay_width, inside = facade.room_depth + 0.3;
    const double top = facade.ground_floor + 3.0 * facade.upper_floors;
    box(scene.still, {0, 0.35, facade.ground_floor}, {length, depth, top}, plaster);
    box(scene.still, {0, inside, 0}, {length, depth, facade.ground_floor}, plaster);
    for (const double x : {0.0, length - end_wall})
        box(scene.still, {x, 0.3, 0}, {x + end_wall, inside, facade.ground_floor}, plaster);
    return std::move(scene.still);
}

/// A panel of a site fence: a frame with bars on two feet.
Mesh fence_mesh() {
    Mesh mesh;
    constexpr double length = fence_length, high = 2.0;
    for (const double z : {0.15, 1.05, high - 0.04})
        box(mesh, {0, -0.02, z}, {length, 0.02, z + 0.04}, bar);
    for (const double x : row(0.0, length, 0.125))
        box(mesh, {x, -0.01, 0.15}, {x + 0.02, 0.01, high}, bar);
    for (const double x : {0.1, length - 0.3})
        box(mesh, {x, -0.3, 0}, {x + 0.2, 0.3, 0.15}, concrete);
    return mesh;
}

/// Goods on a pallet.
Mesh pallet_mesh() {
    Mesh mesh;
    for (const double y : {-0.4, -0.05, 0.3}) box(mesh, {-0.6, y, 0}, {0.6, y + 0.1, 0.1}, wood);
    box(mesh, {-0.6, -0.4, 0.1}, {0.6, 0.4, 0.14}, wood);
    box(mesh, {-0.55, -0.38, 0.14}, {0.5, 0.36, 0.9}, stones);
    return mesh;
}

Mesh barrier_mesh() {
    Mesh mesh;
    add_prism(mesh, Affine3d::Identity(),
              {{-0.3, 0},
               {0.3, 0},
               {0.3, 0.1},
               {0.1, 0.3},
               {0.08, 0.85},
               {-0.08, 0.85},
               {-0.1, 0.3},
               {-0.3, 0.1}},
              0.9, concrete);
    return mesh;
}

}  // namespace

std::vector<Mesh> library(std::uint64_t seed) {
    std::vector<Mesh> meshes = prototypes();
    Random random{hash(seed, 0x11b)};
    const auto add = [&](const auto& make) {
        Scene scene;
        make(scene);
        meshes.push_back(std::move(scene.still));
    };
    meshes.push_back(slab_mesh());
    for (int bays = house_bays[0]; bays <= house_bays[1]; ++bays) {
        for (int i = 0; i < houses_of_a_size; ++i)
            meshes.push_back(house_mesh(bays, random.bits()));
    }
    for (int i = 0; i < trees; ++i) {
        const std::uint64_t shape = random.bits();
        add([&](Scene& scene) { add_tree(scene, {}, random.uniform(6.0, 9.0), shape); });
    }
    for (int i = 0; i < planters; ++i) {
        add([&](Scene& scene) { add_planter(scene, {}, random.bits()); });
    }
    add([](Scene& scene) { add_bench(scene, {}); });
    add([](Scene& scene) { add_bin(scene, {}); });
    add([](Scene& scene) { add_lamp(scene, {}, 6.5); });
    add([](Scene& scene) { add_sign(scene, {}); });
    meshes.push_back(fence_mesh());
    meshes.push_back(pallet_mesh());
    meshes.push_back(barrier_mesh());
    return meshes;
}

}  // namespace dynamic_filter::sim::city
