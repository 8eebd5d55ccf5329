// SPDX-License-Identifier: MIT
#include "live/outputs.hpp"

#include <gtest/gtest.h>

#include "formats/messages/messages.hpp"
#include "live/fake_bus.hpp"

namespace dynamic_filter::live {
namespace outputs_test {

using test::FakeBus;
constexpr std::int64_t kStamp = 1'700'000'000'123'456'789;

/// Four points with a field of their number: static, dynamic, unknown, static.
LiveScan scan_of_four() {
    LiveScan scan;
    for (const char* axis : {"x", "y", "z"}) io::add_field(scan.cloud, axis, io::FieldType::f32);
    io::add_field(scan.cloud, "number", io::FieldType::u16);
    for (std::uint16_t i = 0; i < 4; ++i) {
        const std::array<float, 3> at{static_cast<float>(i), 1.0F, 2.0F};
        const auto* bytes = reinterpret_cast<const std::byte*>(at.data());
        scan.cloud.data.insert(scan.cloud.data.end(), bytes, bytes + sizeof at);
        const auto* number = reinterpret_cast<const std::byte*>(&i);
        scan.cloud.data.insert(scan.cloud.data.end(), number, number + sizeof i);
    }
    scan.frame = "lidar";
    scan.world = "map";
    scan.stamp_ns = kStamp;
    scan.stamp = 1e-9 * static_cast<double>(kStamp);
    scan.has_pose = true;
    scan.T_world_sensor = Pose(Eigen::Translation3d(10.0, 0.0, 0.0));
    return scan;
}

Verdict verdict_on_four() {
    return {0,
            {Label::static_, Label::dynamic, Label::unknown, Label::static_},
            {0.9F, 0.1F, 0.0F, 0.8F}};
}

struct Published {
    LiveConfig config;
    FakeBus bus;
    io::CloudMessage cloud(const std::string& name) const {
        const auto messages = bus.published("/dynamicfilter" + name);
        EXPECT_EQ(messages.size(), 1U) << name;
        return io::read_cloud_message(*messages.at(0),
                                      {name, "sensor_msgs/PointCloud2", bus.encoding()});
    }
    std::vector<double> column(const std::string& name, const char* field) const {
        const io::Cloud read = cloud(name).cloud;
        return io::values(read, *read.find(field));
    }
};

class OutputsInBothEncodings : public testing::TestWithParam<io::MessageEncoding> {};

TEST_P(OutputsInBothEncodings, PointsKeepAllFieldsAndTheExactStamp) {
    Published p;
    p.bus.used = GetParam();
    Outputs outputs(p.config, p.bus.used, p.bus);
    outputs.judged(scan_of_four(), verdict_on_four());
    EXPECT_EQ(p.column("/static", "number"), (std::vector<double>{0, 2, 3}))
        << "unknown points stay";
    EXPECT_EQ(p.column("/dynamic", "number"), (std::vector<double>{1}));
    for (const char* name : {"/static", "/dynamic", "/labels"}) {
        EXPECT_EQ(p.cloud(name).header.stamp_ns, kStamp) << name;
        EXPECT_EQ(p.cloud(name).header.frame, "lidar") << name;
    }
    EXPECT_EQ(p.column("/labels", "label"), (std::vector<double>{9, 251, 0, 9}));
    EXPECT_EQ(p.column("/labels", "x"), (std::vector<double>{0, 1, 2, 3}));
    EXPECT_FLOAT_EQ(static_cast<float>(p.column("/labels", "probability")[3]), 0.8F);
}

INSTANTIATE_TEST_SUITE_P(, OutputsInBothEncodings,
                         testing::Values(io::MessageEncoding::cdr, io::MessageEncoding::ros1));

TEST(Outputs, UnknownPointsGoIfTheMapDoesNotKeepThem) {
    Published p;
    p.config.filter.map.keep_unknown = false;
    Outputs outputs(p.config, p.bus.used, p.bus);
    outputs.judged(scan_of_four(), verdict_on_four());
    EXPECT_EQ(p.column("/static", "number"), (std::vector<double>{0, 3}));
}

TEST(Outputs, WhatNobodyWantsIsNotMade) {
    Published p;
    p.bus.wanted = false;
    Outputs outputs(p.config, p.bus.used, p.bus);
    outputs.judged(scan_of_four(), verdict_on_four());
    EXPECT_TRUE(p.bus.published("/dynamicfilter/static").empty());
    EXPECT_TRUE(p.bus.published("/dynamicfilter/labels").empty());
    EXPECT_FALSE(outputs.wants_map());
}

TEST(Outputs, CorrectionsHoldThePointsThatChanged) {
    Published p;
    Outputs outputs(p.config, p.bus.used, p.bus);
    const JudgedScan judged = outputs.judged(scan_of_four(), verdict_on_four());
    Verdict later = verdict_on_four();
    later.labels[2] = Label::dynamic;
    later.probability[2] = 0.25F;
    outputs.settled(judged, later);
    EXPECT_EQ(p.column("/corrections", "index"), (std::vector<double>{2}));
    EXPECT_EQ(p.column("/corrections", "label"), (std::vector<double>{251}));
    EXPECT_EQ(p.column("/corrections", "x"), (std::vector<double>{2}));
    EXPECT_EQ(p.cloud("/corrections").header.stamp_ns, kStamp);
}

TEST(Outputs, TheMapIsLatchedAndInTheWorldFrame) {
    Published p;
    Outputs outputs(p.config, p.bus.used, p.bus);
    EXPECT_TRUE(p.bus.advertised.at("/dynamicfilter/map").latched);
    p.bus.wanted = false;
    outputs.map({{Eigen::Vector3d(1, 2, 3), 0.75F}}, "map", 5.0);
    EXPECT_EQ(p.column("/map", "z"), (std::vector<double>{3})) << "for those who come later";
    EXPECT_EQ(p.cloud("/map").header.frame, "map");
}

TEST(Outputs, TheOwnOdometryLinksItsWorldToTheRootOfTf) {
    Published p;
    Outputs outputs(p.config, p.bus.used, p.bus);
    LiveScan scan = scan_of_four();
    scan.has_pose = false;
    scan.root = "odom";
    scan.T_root_sensor = Pose(Eigen::Translation3d(3.0, 0.0, 0.0));
    Verdict verdict = verdict_on_four();
    verdict.tracked.emplace();
    verdict.tracked->T_world_sensor = Pose(Eigen::Translation3d(5.0, 0.0, 0.0));
    outputs.judged(scan, verdict);
    const auto messages = p.bus.published("/tf");
    ASSERT_EQ(messages.size(), 1U);
    const io::Topic topic{"/tf", "tf2_msgs/TFMessage", p.bus.used};
    const auto transforms = io::read_transforms({topic, 0, {}, *messages[0]});
    ASSERT_EQ(transforms.size(), 1U);
    EXPECT_EQ(transforms[0].parent, "map");
    EXPECT_EQ(transforms[0].child, "odom");
    EXPECT_NEAR(transforms[0].T_parent_child.translation().x(), 2.0, 1e-9);
}

TEST(Outputs, ADisplayGetsThePoseOfTheSensor) {
    Published p;
    FakeBus display;
    Outputs outputs(p.config, p.bus.used, p.bus, &display);
    outputs.judged(scan_of_four(), verdict_on_four());
    EXPECT_EQ(display.published("/dynamicfilter/labels").size(), 1U);
    const auto messages = display.published("/tf");
    ASSERT_EQ(messages.size(), 1U);
    const io::Topic topic{"/tf", "tf2_msgs/TFMessage", p.bus.used};
    const auto transforms = io::read_transforms({topic, 0, {}, *messages[0]});
    EXPECT_EQ(transforms.at(0).parent, "map");
    EXPECT_EQ(transforms.at(0).child, "lidar");
    EXPECT_NEAR(transforms.at(0).T_parent_child.translation().x(), 10.0, 1e-9);
}

TEST(Outputs, GivenPosesAreNotPublishedAgain) {
    Published p;
    Outputs outputs(p.config, p.bus.used, p.bus);
    outputs.judged(scan_of_four(), verdict_on_four());
    EXPECT_TRUE(p.bus.published("/tf").empty());
}

TEST(Outputs, MessagesThatAreNotTakenAreCounted) {
    Published p;
    p.bus.takes = false;
    Outputs outputs(p.config, p.bus.used, p.bus);
    outputs.judged(scan_of_four(), verdict_on_four());
    EXPECT_GE(outputs.not_taken(), 3U);
}

TEST(Outputs, BoxesSurroundDynamicPointsThatAreNear) {
    Points points;
    Labels labels;
    const auto add = [&](float x, int count, Label label) {
        for (int i = 0; i < count; ++i) {
            points.emplace_back(x + 0.1F * static_cast<float>(i), 0.0F, 1.0F);
            labels.push_back(label);
        }
    };
    add(0.0F, 20, Label::dynamic);   // 1.9 m long, over several cells
    add(50.0F, 8, Label::dynamic);   // another one
    add(80.0F, 3, Label::dynamic);   // too few
    add(20.0F, 50, Label::static_);  // a wall
    const auto boxes = boxes_around(points, labels, Pose(Eigen::Translation3d(100.0, 0.0, 0.0)));
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_NEAR(boxes[0].center.x(), 100.95, 1e-3) << "that of most points first, in the world";
    EXPECT_NEAR(boxes[0].size.x(), 1.9, 1e-3);
    EXPECT_NEAR(boxes[1].center.x(), 150.35, 1e-3);
}

}  // namespace outputs_test
}  // namespace dynamic_filter::live
