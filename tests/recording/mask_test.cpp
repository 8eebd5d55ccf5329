// SPDX-License-Identifier: MIT
#include "recording/mask.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace mask_test {

class Mask : public RecordingFiles {
protected:
    [[nodiscard]] Boxes boxes(const std::string& text) const {
        data.put("mask.txt", text);
        return read_boxes(data / "mask.txt");
    }
    /// The message about a mask file with this text.
    [[nodiscard]] std::string fault(const std::string& text) const {
        try {
            (void)boxes(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(Mask, IsALineForEachBox) {
    const Boxes read = boxes("# the mast\n-1 -0.5 -1 0 0.5 1\n\n1, 1, 1, 2, 2, 3 # a box\n");
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].min(), Point(-1.0F, -0.5F, -1.0F));
    EXPECT_EQ(read[1].max(), Point(2.0F, 2.0F, 3.0F));
}

TEST_F(Mask, ThatIsNoneIsRefusedWithItsLine) {
    EXPECT_NE(fault("0 0 0 1 1 1\n0 0 0 1 1\n").find("(line 2)"), std::string::npos);
    EXPECT_NE(fault("0 0 0 1 1 1 7\n").find("(line 1)"), std::string::npos);
    EXPECT_NE(fault("1 0 0 0 1 1\n").find("the lowest x y z of a box"), std::string::npos);
    EXPECT_NE(fault("car\n").find("(line 1)"), std::string::npos);
    EXPECT_NE(fault("# nothing\n").find("has no box"), std::string::npos);
    EXPECT_THROW((void)read_boxes(data / "missing.txt"), InputError);
}

TEST_F(Mask, TakesPointsOutAndLabelsThemDynamic) {
    const Boxes box = {Eigen::AlignedBox3f(Point(-1, -1, -1), Point(1, 1, 1))};
    Points points = {{0.5F, 0, 0}, {2, 0, 0}, {0, 0, 0}, {-1, 1, 1}};
    const auto own = take_out(box, points);
    EXPECT_EQ(own, (std::vector<std::uint8_t>{1, 0, 0, 1}));
    EXPECT_EQ(points[0], Point::Zero());
    EXPECT_EQ(points[1], Point(2, 0, 0));
    Labels labels(4, Label::unknown);
    label_own_body(own, labels);
    EXPECT_EQ(labels, (Labels{Label::dynamic, Label::unknown, Label::unknown, Label::dynamic}));
    Points far = {{3, 0, 0}};
    EXPECT_TRUE(take_out(box, far).empty());
    EXPECT_TRUE(take_out({}, points).empty());
}

TEST_F(Mask, OfARecordingIsOfTheSensorFrame) {
    put_bins("scans", 2);  // points (1, 2, 3) and (4, 5, 6)
    const Boxes box = {Eigen::AlignedBox3f(Point(0.5F, 1.5F, 2.5F), Point(1.5F, 2.5F, 3.5F))};
    const FullScan scan = with_own_body(open(), box).read(0);
    EXPECT_EQ(scan.own, (std::vector<std::uint8_t>{1, 0}));
    EXPECT_FALSE(is_measured(scan.points[0]));
    EXPECT_TRUE(open().read(0).own.empty());
}

TEST_F(Mask, PointsInOtherUnitsAreReadInMetres) {
    put_bins("scans", 1);
    OpenOptions feet;
    feet.point_unit = 0.3048;
    const FullScan scan = open(feet).read(0);
    EXPECT_LT((scan.points[1] - 0.3048F * Point(4, 5, 6)).norm(), 1e-5F);
    data.put("poses.txt", "1 0 0 1 0 1 0 0 0 0 1 0\n");
    OpenOptions mm;
    mm.points_in_world = true;
    mm.point_unit = 0.001;
    const FullScan world = open(mm).read(0);
    EXPECT_LT((world.points[1] - Point(0.004F - 1.0F, 0.005F, 0.006F)).norm(), 1e-5F);
}

}  // namespace mask_test
}  // namespace dynamic_filter::io
