// SPDX-License-Identifier: MIT
#include "export/georeference.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace georeference_test {

TEST(GeoOrigin, IsReadFromText) {
    const GeoOrigin origin = geo_origin("48.1374,11.5755,520");
    EXPECT_EQ(origin.latitude_deg, 48.1374);
    EXPECT_EQ(origin.longitude_deg, 11.5755);
    EXPECT_EQ(origin.height, 520.0);
    EXPECT_EQ(geo_origin("-33,151").height, 0.0);
    for (const char* text :
         {"", "48", "48,", "48,11,5,6", "91,0", "0,181", "a,b", "48;11", "nan,0"})
        EXPECT_THROW(geo_origin(text), ConfigError) << text;
}

/// Known places of EPSG 4978.
TEST(GeoOrigin, LiesWhereTheEarthIs) {
    const auto at = [](double latitude, double longitude, double height) {
        return Eigen::Vector3d(earth_from_world({latitude, longitude, height}).block<3, 1>(0, 3));
    };
    EXPECT_LT((at(0, 0, 0) - Eigen::Vector3d(6378137.0, 0, 0)).norm(), 1e-6);
    EXPECT_LT((at(90, 0, 0) - Eigen::Vector3d(0, 0, 6356752.314245)).norm(), 1e-5);
    EXPECT_LT((at(0, 90, 100) - Eigen::Vector3d(0, 6378237.0, 0)).norm(), 1e-6);
    const Eigen::Matrix4d east = earth_from_world({0, 0, 0});
    EXPECT_LT((east.block<3, 1>(0, 0) - Eigen::Vector3d::UnitY()).norm(), 1e-12) << "x: east";
    EXPECT_LT((east.block<3, 1>(0, 1) - Eigen::Vector3d::UnitZ()).norm(), 1e-12) << "y: north";
    const Eigen::Matrix3d axes = earth_from_world({48, 11, 0}).block<3, 3>(0, 0);
    EXPECT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
}

}  // namespace georeference_test
}  // namespace dynamic_filter::app
