// SPDX-License-Identifier: MIT
#include "recording/mesh_mask.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "dynamic_filter/error.hpp"
#include "recording/mask.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace mesh_mask_test {

/// The surface of a box, two triangles a side.
std::vector<Triangle> box(const Point& low, const Point& high) {
    const auto corner = [&](int i) {
        return Point((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                     (i & 4) != 0 ? high.z() : low.z());
    };
    std::vector<Triangle> mesh;
    for (const auto& [a, b, c, d] : {std::array{0, 1, 3, 2},
                                     {4, 5, 7, 6},
                                     {0, 1, 5, 4},
                                     {2, 3, 7, 6},
                                     {0, 2, 6, 4},
                                     {1, 3, 7, 5}}) {
        mesh.push_back({corner(a), corner(b), corner(c)});
        mesh.push_back({corner(a), corner(c), corner(d)});
    }
    return mesh;
}

std::string binary(const std::vector<Triangle>& mesh) {
    std::string file(80, ' ');
    const auto put = [&](const auto& value) {
        file.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(static_cast<std::uint32_t>(mesh.size()));
    for (const Triangle& t : mesh) {
        for (int k = 0; k < 3; ++k) put(0.0F);
        for (const Point& corner : t) {
            for (const float value : corner) put(value);
        }
        put(std::uint16_t{0});
    }
    return file;
}

std::string text(const std::vector<Triangle>& mesh) {
    std::string file = "solid car\n";
    for (const Triangle& t : mesh) {
        file += "facet normal 0 0 0\nouter loop\n";
        for (const Point& p : t) {
            file += "vertex " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
                    std::to_string(p.z()) + "\n";
        }
        file += "endloop\nendfacet\n";
    }
    return file + "endsolid\n";
}

class MeshMask : public RecordingFiles {};

TEST_F(MeshMask, HoldsWhatLiesInTheMesh) {
    const std::vector<Triangle> car = box({-2.0F, -0.9F, -1.5F}, {0.0F, 0.9F, -0.3F});
    for (const std::string& contents : {binary(car), text(car)}) {
        data.put("car.stl", contents);
        const Boxes boxes = read_mask(data / "car.stl");
        Points points = {{-1.0F, 0.0F, -1.0F},  {-1.95F, 0.85F, -0.35F}, {0.05F, 0.0F, -1.0F},
                         {-1.0F, 0.0F, -0.1F},  {0.5F, 0.0F, -1.0F},     {-1.0F, 1.5F, -1.0F},
                         {-2.5F, -0.5F, -1.0F}, {-1.0F, 0.0F, -1.8F}};
        EXPECT_EQ(take_out(boxes, points), (std::vector<std::uint8_t>{1, 1, 1, 0, 0, 0, 0, 0}));
    }
}

TEST_F(MeshMask, LeavesTheRoomBetweenItsPartsFree) {
    std::vector<Triangle> mesh = box({-1.0F, -1.0F, 0.0F}, {1.0F, 1.0F, 0.2F});
    const auto roof = box({-1.0F, -1.0F, 2.0F}, {1.0F, 1.0F, 2.2F});
    mesh.insert(mesh.end(), roof.begin(), roof.end());
    const Boxes boxes = boxes_in(mesh);
    Points points = {{0.2F, 0.3F, 0.1F}, {0.2F, 0.3F, 1.0F}, {0.2F, 0.3F, 2.1F}};
    EXPECT_EQ(take_out(boxes, points), (std::vector<std::uint8_t>{1, 0, 1}));
}

TEST_F(MeshMask, WithoutTrianglesIsRefused) {
    for (const char* contents : {"", "solid nothing\nendsolid\n", "vertex 1 2\n"}) {
        data.put("car.stl", contents);
        EXPECT_THROW((void)read_stl(data / "car.stl"), InputError) << contents;
    }
    data.put("car.dae", "<COLLADA/>");
    EXPECT_THROW((void)read_mask(data / "car.dae"), InputError);
}

}  // namespace mesh_mask_test
}  // namespace dynamic_filter::io
