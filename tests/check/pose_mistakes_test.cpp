// SPDX-License-Identifier: MIT
#include "check/pose_mistakes.hpp"

#include <functional>
#include <numbers>

#include "dynamic_filter/motion.hpp"
#include "support/bytes.hpp"
#include "support/random.hpp"

namespace dynamic_filter::io {
namespace pose_mistakes_test {

/// A way with bends and changes of speed, which cannot look like another mistake.
Pose pose_at(double t) {
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(8.0 * t + 2.0 * std::sin(0.9 * t), std::sin(0.7 * t), 0.1);
    pose.linear() = (Eigen::AngleAxisd(0.5 * std::sin(0.8 * t), Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(0.05 * std::sin(1.7 * t), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(0.05 * std::sin(1.1 * t), Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    return pose;
}

/// 60 scans at 10 Hz; `given` says what somebody took for the pose at a time.
TwoTracks tracks(const std::function<Pose(double)>& given) {
    TwoTracks out;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.1 * i;
        out.stamps.push_back(t);
        out.shown.push_back(pose_at(t));
        out.given.push_back(given(t));
    }
    return out;
}

std::string constant_text(const std::vector<TwoTracks>& tracks) {
    return find_constant_mistake(tracks).text;
}

TEST(PoseMistakes, AnOffsetInTime) {
    for (const double offset : {0.1, -0.05}) {
        const std::string text =
            name_mistake({tracks([&](double t) { return pose_at(t + offset); })});
        EXPECT_HAS(text, "offset in time");
        EXPECT_HAS(text, offset > 0.0 ? "100 ms after its scan" : "50 ms before its scan");
    }
}

TEST(PoseMistakes, AnotherFrame) {
    const Pose mount(Eigen::Translation3d(2.0, -1.0, 0.5));
    const std::string text = name_mistake({tracks([&](double t) { return pose_at(t) * mount; })});
    EXPECT_HAS(text, "of a frame that lies (2.0");
    EXPECT_HAS(text, "0.0, 0.0) deg");
}

TEST(PoseMistakes, Jitter) {
    test::Random random(1);
    const std::string text =
        name_mistake({tracks([&](double t) { return pose_at(t) * random.pose(0.05, 0.01); })});
    EXPECT_HAS(text, "the poses jitter");
}

TEST(PoseMistakes, Drift) {
    const std::string text = name_mistake({tracks([](double t) {
        Pose pose = pose_at(t);
        pose.translation() *= 1.05;
        return Pose(Eigen::AngleAxisd(0.05 * t, Eigen::Vector3d::UnitZ()) * pose);
    })});
    EXPECT_HAS(text, "the poses drift");
}

TEST(PoseMistakes, WhereTheWorldLiesIsNone) {
    const Pose world = Eigen::Translation3d(400.0, -50.0, 3.0) *
                       Pose(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
    const std::string text = name_mistake({tracks([&](double t) { return world * pose_at(t); })});
    EXPECT_HAS(text, "off by 0.0 cm and 0.00 deg");
}

// Too small to blur the scans.
TEST(PoseMistakes, ALateOrShiftedPathIsNamedWhereScansDoNotBlur) {
    EXPECT_HAS(constant_text({tracks([](double t) { return pose_at(t + 0.05); })}),
               "50 ms after its scan");
    const Pose mount(Eigen::Translation3d(0.5, 0.0, 0.0));
    EXPECT_HAS(constant_text({tracks([&](double t) { return pose_at(t) * mount; })}),
               "of a frame that lies (0.5");
}

TEST(PoseMistakes, MendedPosesAreThoseOfTheSensor) {
    const Pose mount(Eigen::Translation3d(2.0, -1.0, 0.5));
    const std::vector<TwoTracks> late = {tracks([](double t) { return pose_at(t + 0.05); })},
                                 shifted = {tracks([&](double t) { return pose_at(t) * mount; })};
    for (const auto& mistaken : {late, shifted}) {
        const ConstantMistake mistake = find_constant_mistake(mistaken);
        ASSERT_EQ(mistake.mended.size(), 1U);
        for (std::size_t i = 5; i < 55; ++i) {
            const Pose off = mistake.mended[0][i].inverse() * mistaken[0].shown[i];
            EXPECT_LT(off.translation().norm(), 0.05) << i;
        }
    }
}

TEST(PoseMistakes, WhatMayBeTheOdometrysErrorIsNotNamedWhereScansDoNotBlur) {
    test::Random random(1);
    EXPECT_EQ(constant_text({tracks(pose_at)}), "");
    EXPECT_EQ(constant_text({tracks([](double t) { return pose_at(t + 0.002); })}), "");
    EXPECT_EQ(
        constant_text({tracks([&](double t) { return pose_at(t) * random.pose(0.05, 0.01); })}),
        "");
}

}  // namespace pose_mistakes_test
}  // namespace dynamic_filter::io
