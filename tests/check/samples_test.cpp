// SPDX-License-Identifier: MIT
#include "check/samples.hpp"

#include <cmath>

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace samples_test {

class SamplesTest : public RecordingFiles {
protected:
    /// The second of two scans of these points; its pose is 100 m away.
    [[nodiscard]] Sample sample_of(const Points& points) const {
        for (const char* name : {"velodyne/000000.bin", "velodyne/000001.bin"}) {
            std::string bytes;
            for (const Point& p : points) bytes += floats({p.x(), p.y(), p.z(), 0});
            data.put(name, bytes);
        }
        data.put("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 100 0 1 0 0 0 0 1 0\n");
        std::map<std::size_t, std::string> unusable;
        const Samples samples = read_samples(open(), choose_pairs(2, 1), unusable);
        EXPECT_TRUE(unusable.empty());
        return samples.at(1);
    }
};

TEST(ChoosePairs, StartAtEvenStepsAndStayInTheRecording) {
    const auto pairs = choose_pairs(40, 2);
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (const Pair& p : pairs) found.emplace_back(p.from, p.apart);
    const std::vector<std::pair<std::size_t, std::size_t>> expected{
        {0, 1}, {0, 3}, {0, 8}, {0, 20}, {20, 1}, {20, 3}, {20, 8}};
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(choose_pairs(1, 3).empty());
}

TEST(Comparable, LeavesOutPairsThatAreFarApartUnlessNeighborsAreToo) {
    const std::vector<Pair> pairs = choose_pairs(40, 1);
    const auto count_at = [&](double step) {
        Samples samples;
        for (std::size_t i = 0; i < 40; ++i) {
            samples[i].T_world_sensor.translation().x() = step * static_cast<double>(i);
        }
        return comparable(samples, pairs).size();
    };
    EXPECT_EQ(count_at(0.0), 4U);
    EXPECT_EQ(count_at(1.0), 4U);
    EXPECT_EQ(count_at(2.6), 2U);  // 8 scans are 20.8 m
    EXPECT_EQ(count_at(19.0), 1U);
    EXPECT_EQ(count_at(600.0), 4U);  // such as poses in millimetres
}

TEST_F(SamplesTest, OnlyTheUpperPartOfUprightStructuresWithin30MetresIsKept) {
    Points points;
    for (int i = 0; i <= 10; ++i) {
        const float z = 0.1F * static_cast<float>(i);
        for (const float x : {1.0F, 10.1F, 40.1F}) points.emplace_back(x, 0.1F, z);
    }
    points.emplace_back(5.0F, 5.0F, -1.0F);  // ground
    const Sample sample = sample_of(points);
    EXPECT_EQ(sample.upright.size(), 8U);  // from 0.3 m on
    for (const Point& p : sample.upright) {
        EXPECT_EQ(p.x(), 10.1F);
        EXPECT_GT(p.z(), 0.25F);
    }
}

TEST_F(SamplesTest, KnowsHowFarThePointsAreFromTheSensorAndFromItsPose) {
    const Sample sample =
        sample_of({{5, 0, 0}, {5.9F, 0, 0}, {6.1F, 0, 0}, {101, 0, 0}, {0, 0, 0}});
    EXPECT_EQ(sample.near_origin, 2U);
    EXPECT_EQ(sample.near_pose, 1U);
    EXPECT_EQ(sample.typical_range, 6.1F);
    EXPECT_EQ(sample.T_world_sensor.translation().x(), 100.0);
}

TEST_F(SamplesTest, PointsInOneDirectionAtDifferentRangesAreDoubled) {
    Points points;
    for (int i = 0; i < 100; ++i) {
        const float angle = 0.05F * static_cast<float>(i) + 0.001F;
        const float beside = angle + 0.0002F;  // a twentieth of a pixel
        points.push_back(10.0F * Point(std::cos(angle), std::sin(angle), 0.0F));
        points.push_back(15.0F * Point(std::cos(beside), std::sin(beside), 0.0F));
    }
    EXPECT_GT(sample_of(points).doubled, 0.8);
    for (Point& p : points) p = 10.0F * p.normalized();
    EXPECT_EQ(sample_of(points).doubled, 0.0);
}

TEST_F(SamplesTest, UnusableScansAreNamed) {
    put_bins("velodyne", 3);
    data.put("velodyne/000001.bin", "123");
    data.put("poses.txt", kitti_rows(3));
    std::map<std::size_t, std::string> unusable;
    const Samples samples = read_samples(open(), choose_pairs(3, 1), unusable);
    EXPECT_EQ(samples.size(), 1U);  // scan 2 is in no pair
    ASSERT_EQ(unusable.size(), 1U);
    EXPECT_HAS(unusable.at(1), "000001.bin");
}

}  // namespace samples_test
}  // namespace dynamic_filter::io
