// SPDX-License-Identifier: MIT
#include "recording/layouts/nuscenes_truth.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace nuscenes_truth_test {

/// Of an object that is 2 m wide, 4 m long and 1 m high, at (10, 0, 0) and turned to the left.
std::string annotation(const std::string& sample, const std::string& instance,
                       const std::string& attributes) {
    return R"({"sample_token": ")" + sample + R"(", "instance_token": ")" + instance +
           R"(", "attribute_tokens": [)" + attributes +
           R"(], "translation": [10, 0, 0], "rotation": [0.70710678, 0, 0, 0.70710678],)" +
           R"( "size": [2, 4, 1]})";
}

class NuscenesTruth : public RecordingFiles {
protected:
    void SetUp() override {
        table("attribute", R"({"token": "m", "name": "vehicle.moving"},)"
                           R"({"token": "r", "name": "cycle.with_rider"},)"
                           R"({"token": "p", "name": "vehicle.parked"})");
    }
    void table(const std::string& name, const std::string& entries) const {
        data.put(name + ".json", "[" + entries + "]");
    }
    [[nodiscard]] auto boxes() const { return nuscenes::moving_boxes(data.path(), {"k1", "k2"}); }
};

TEST_F(NuscenesTruth, WhatMovesAtOneSampleIsDynamicAtAll) {
    EXPECT_TRUE(boxes().empty());  // no table
    table("sample_annotation", annotation("other", "car", R"("m")"));
    EXPECT_TRUE(boxes().empty());  // none of these samples
    table("sample_annotation",
          annotation("k1", "car", R"("p")") + "," + annotation("k2", "car", R"("m")") + "," +
              annotation("k1", "rider", R"("p", "r")") + "," +
              annotation("k1", "parked", R"("p")") + "," + annotation("k1", "barrier", ""));
    EXPECT_EQ(boxes().at("k1").size(), 2U);
    EXPECT_EQ(boxes().at("k2").size(), 1U);
    table("sample_annotation", annotation("k1", "parked", R"("p")"));
    EXPECT_TRUE(boxes().at("k2").empty());  // nothing moves there, and that is known
    table("sample_annotation", R"({"sample_token": "k1"})");
    EXPECT_HAS(error_of([&] { (void)boxes(); }), "no table of nuScenes");
}

TEST_F(NuscenesTruth, PointsInTheBoxAreDynamic) {
    table("sample_annotation", annotation("k1", "car", R"("m")"));
    Pose T_world_sensor = Pose::Identity();
    T_world_sensor.translation().x() = 10.0;
    // The box is long along y, because it is turned.
    const Points points{{0, 1.9F, 0}, {0.9F, 0, 0}, {0, 0, 0.4F},
                        {1.1F, 0, 0}, {0, 2.1F, 0}, {0, 0, 0.6F}};
    const Labels truth = nuscenes::truth_by(boxes().at("k1"), points, T_world_sensor);
    EXPECT_EQ(truth, (Labels{Label::dynamic, Label::dynamic, Label::dynamic, Label::static_,
                             Label::static_, Label::static_}));
}

}  // namespace nuscenes_truth_test
}  // namespace dynamic_filter::io
