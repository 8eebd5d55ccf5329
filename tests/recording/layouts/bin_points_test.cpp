// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"

#include <cmath>

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace bin_points_test {

/// Files with 5, 6, 7... points of so many floats each.
class BinPoints : public RecordingFiles {
protected:
    void put_points(const std::string& folder, std::size_t floats_per_point, int files) const {
        for (int i = 0; i < files; ++i) {
            const auto points = static_cast<std::size_t>(5 + i);
            data.put(folder + "/" + std::to_string(100 + i) + ".bin",
                     std::string(4 * floats_per_point * points, '\0'));
        }
    }
};

TEST_F(BinPoints, OtherThanFourFloatsAreNamedBeforeAnythingIsRead) {
    for (const char* folder : {"velodyne", "lidar"}) {
        put_points(folder, 6, 8);  // as in Boreas; every second size is a multiple of 16, too
        EXPECT_HAS(open_error(), "24 bytes a point");
        std::filesystem::remove_all(data / folder);
        put_points(folder, 3, 8);
        EXPECT_HAS(open_error(), "12 bytes a point");
        std::filesystem::remove_all(data / folder);
        put_points(folder, 5, 8);
        EXPECT_HAS(open_error(), "20 bytes a point");
        EXPECT_HAS(open_error(), "name them *.pcd.bin");
        std::filesystem::remove_all(data / folder);
        put_points(folder, 4, 8);
        EXPECT_EQ(open().size(), 8U);
        std::filesystem::remove_all(data / folder);
    }
}

TEST_F(BinPoints, ATruncatedFileAmongOthersIsLeftToTheReader) {
    put_points("velodyne", 4, 8);
    data.put("velodyne/103.bin", std::string(5 * 16 + 5, '\0'));
    const Recording recording = open();
    EXPECT_EQ(recording.size(), 8U);
    EXPECT_HAS(error_of([&] { (void)recording.read(3); }), "truncated after point 5");
}

/// Value k of point i of a ring around the sensor, 2000 points a turn.
double value_of(std::size_t k, std::size_t i) {
    const double angle = 0.00314 * static_cast<double>(i);
    const double range = 10.0 + 3.0 * std::sin(5.0 * angle);
    if (k == 0) return range * std::cos(angle);
    if (k == 1) return range * std::sin(angle);
    return k == 2 ? -1.5 + 0.1 * std::sin(angle) : 0.0;
}

template <class T>
std::string ring_of_points(std::size_t values, const std::vector<double>& others) {
    std::string bytes;
    for (std::size_t i = 0; i < 640; ++i) {
        for (std::size_t k = 0; k < values; ++k)
            bytes += bytes_of(static_cast<T>(k < 3 ? value_of(k, i) : others[k - 3]));
    }
    return bytes;
}

TEST_F(BinPoints, ContentsTellTheLayout) {
    struct Case {
        std::string bytes, names;
    };
    for (const auto& [bytes, names] :
         {Case{ring_of_points<float>(3, {}), "float32 x y z,"},
          Case{ring_of_points<float>(5, {0.5, 7.0}), "float32 x y z intensity ring,"},
          Case{ring_of_points<float>(6, {0.5, 0.25, 0.01}), "float32 x y z intensity c4 c5,"},
          Case{ring_of_points<float>(8, {1.0, 0.3, 0.0, 0.0, 0.0}),
               "float32 x y z c3 intensity c5 c6 c7,"},
          Case{ring_of_points<float>(8, {1.0, 0.0, 0.0, 0.0, 0.0}),
               "float32 x y z c3 intensity c5 c6 c7,"},
          Case{ring_of_points<double>(3, {}), "float64 x y z,"},
          Case{ring_of_points<double>(4, {0.3}), "float64 x y z intensity,"}}) {
        data.put("velodyne/0.bin", bytes);
        data.put("velodyne/1.bin", bytes + bytes.substr(0, bytes.size() / 2));
        const Recording recording = open();
        EXPECT_TRUE(has_note(recording, names)) << names;
        const FullScan scan = recording.read(1);
        ASSERT_EQ(scan.points.size(), 960U) << names;
        EXPECT_NEAR(scan.points[100].x(), value_of(0, 100), 1e-5);
        EXPECT_NO_THROW(recording.check(0));
    }
}

TEST_F(BinPoints, FourFloatsStayFourFloats) {
    data.put("velodyne/0.bin", ring_of_points<float>(4, {0.5}));
    EXPECT_FALSE(has_note(open(), "float32"));
    EXPECT_EQ(open().read(0).points.size(), 640U);
    // Two returns of each beam, the second one far behind the first.
    std::string two;
    for (std::size_t i = 0; i < 640; ++i) {
        for (const double times : {1.0, 4.0}) {
            for (std::size_t k = 0; k < 3; ++k)
                two += bytes_of(static_cast<float>(times * value_of(k, i)));
            two += bytes_of(0.001F * static_cast<float>(i % 7));
        }
    }
    data.put("velodyne/0.bin", two);
    EXPECT_EQ(open().read(0).points.size(), 1280U);
    // Every second beam without a return, and nothing in the place of the intensity.
    std::string other;
    for (std::size_t i = 0; i < 640; ++i) {
        for (const double range : {100.0, 1.0}) {
            for (std::size_t k = 0; k < 3; ++k)
                other += bytes_of(static_cast<float>(range == 1.0 ? value_of(k, i)
                                                     : k == 0     ? range
                                                                  : 0));
            other += bytes_of(0.0F);
        }
    }
    data.put("velodyne/0.bin", other);
    EXPECT_FALSE(has_note(open(), "float32"));
}

TEST_F(BinPoints, FourFloatsMayBeInTheWorldOrInMillimetres) {
    std::string far;
    for (std::size_t i = 0; i < 640; ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            far += bytes_of(static_cast<float>(4.5e5 + value_of(k, i)));
        far += bytes_of(0.5F);
    }
    data.put("velodyne/0.bin", far);
    EXPECT_FALSE(has_note(open(), "float32"));
}

TEST_F(BinPoints, ATruncatedFileOfAnotherLayoutIsNamed) {
    const std::string bytes = ring_of_points<float>(5, {0.5, 7.0});
    for (int i = 0; i < 12; ++i) data.put("velodyne/" + std::to_string(i) + ".bin", bytes);
    data.put("velodyne/3.bin", bytes.substr(0, 47));
    const Recording recording = open();
    EXPECT_HAS(error_of([&] { recording.check(3); }), "no multiple of 20");
    EXPECT_HAS(error_of([&] { (void)recording.read(3); }), "byte 40");
}

TEST_F(BinPoints, ContentsWithoutPointsAreNamedWithWhatWasTried) {
    std::string noise;
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < 4000; ++i) {
        state = state * 1664525U + 1013904223U;
        noise += bytes_of(state);
    }
    data.put("velodyne/0.bin", noise);
    EXPECT_HAS(open_error(), "tried float32 x y z intensity, float32 x y z,");
}

TEST_F(BinPoints, SizesOfVeryFewFilesProveNothing) {
    put_points("velodyne", 6, 3);
    EXPECT_EQ(open().size(), 3U);
}

}  // namespace bin_points_test
}  // namespace dynamic_filter::io
