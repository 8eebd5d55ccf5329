// SPDX-License-Identifier: MIT
#include "export/normals.hpp"

#include <gtest/gtest.h>

#include <random>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::app {
namespace normals_test {

const std::array<std::string, 3> kNames = normal_names("map.ply");

/// x y z, and a direction to the sensor.
io::Cloud cloud_of(const std::vector<std::pair<Eigen::Vector3f, Eigen::Vector3f>>& points) {
    io::Cloud cloud;
    for (const char* name : {"x", "y", "z"}) io::add_field(cloud, name, io::FieldType::f32);
    for (const std::string& name : kNames) io::add_field(cloud, name, io::FieldType::f32);
    for (const auto& [place, to_sensor] : points) {
        for (const Eigen::Vector3f& values : {place, to_sensor}) {
            const auto bytes = std::as_bytes(std::span(values.data(), 3));
            cloud.data.insert(cloud.data.end(), bytes.begin(), bytes.end());
        }
    }
    return cloud;
}

Eigen::Vector3f normal(const io::Cloud& cloud, std::size_t i) {
    Eigen::Vector3f normal;
    for (int axis = 0; axis < 3; ++axis) {
        normal[axis] = static_cast<float>(
            io::values(cloud, *cloud.find(kNames[static_cast<std::size_t>(axis)]))[i]);
    }
    return normal;
}

TEST(FitNormals, PointToTheSensorFromBothSidesOfAWall) {
    std::mt19937 random(1);
    const Eigen::Vector3f tilted = Eigen::Vector3f(1.0F, 2.0F, 3.0F).normalized();
    const Eigen::Vector3f along = tilted.unitOrthogonal(), across = tilted.cross(along);
    const auto share = [&] { return static_cast<float>(random() % 1000) / 500.0F - 1.0F; };
    std::vector<std::pair<Eigen::Vector3f, Eigen::Vector3f>> points;
    for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector3f place = share() * along + share() * across;
        const float side = i % 2 == 0 ? 5.0F : -5.0F;
        points.emplace_back(place + Eigen::Vector3f::Constant(500.0F), side * tilted + along);
    }
    points.emplace_back(Eigen::Vector3f(0.0F, 0.0F, 0.0F), tilted);  // alone
    io::Cloud cloud = cloud_of(points), by_one = cloud;
    fit_normals(cloud, kNames, 0.3);
    for (std::size_t i = 0; i < 2000; ++i) {
        const float side = i % 2 == 0 ? 1.0F : -1.0F;
        ASSERT_GT(normal(cloud, i).dot(side * tilted), 0.999F) << i;
    }
    EXPECT_TRUE(normal(cloud, 2000).isZero());
    with_threads(1, [&] { fit_normals(by_one, kNames, 0.3); });
    EXPECT_EQ(cloud.data, by_one.data);
}

TEST(TurnNormals, TurnsThemAndKeepsTheirLength) {
    io::Cloud cloud =
        cloud_of({{Point(1, 2, 3), Point(1, 0, 0)}, {Point(1, 2, 4), Point(0, 0, 0)}});
    const auto turn = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    turn_normals(cloud, kNames, turn);
    EXPECT_LT((normal(cloud, 0) - Point(0, 1, 0)).norm(), 1e-6F);
    EXPECT_TRUE(normal(cloud, 1).isZero());  // a point alone has none
    EXPECT_EQ(io::positions(cloud)[0], Point(1, 2, 3));
}

TEST(FitNormals, NamesAreThoseThatReadersLookFor) {
    EXPECT_EQ(normal_names("a.ply")[0], "nx");
    EXPECT_EQ(normal_names("a.pcd")[2], "normal_z");
}

}  // namespace normals_test
}  // namespace dynamic_filter::app
