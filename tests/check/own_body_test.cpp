// SPDX-License-Identifier: MIT
#include "check/own_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"
#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace own_body_test {

class OwnBodyOf : public StreetRecording {
protected:
    /// The street, in which beams that meet the box end there.
    [[nodiscard]] OwnBody found(const Eigen::AlignedBox3f& box, bool moves = true) const {
        test::Drive drive = street(false);
        test::Random random(4);
        for (Scan& scan : drive.scans) {
            for (Point& p : scan.points) {
                const float share = enters(box, p);
                if (share < 1.0F) p *= share * random.uniform_f(0.99F, 1.01F);
            }
        }
        if (!moves) {
            for (Scan& scan : drive.scans) scan.points = drive.scans.front().points;
            put(drive, std::vector<Pose>(drive.scans.size(), Pose::Identity()));
        } else {
            put(drive, drive.truth);
        }
        return find_own_body(open());
    }
    /// Share of the way to the point at which the beam enters the box; 1 if it does not.
    static float enters(const Eigen::AlignedBox3f& box, const Point& p) {
        if (box.isEmpty() || !is_measured(p)) return 1.0F;
        float from = 0.0F, to = 1.0F;
        for (int axis = 0; axis < 3; ++axis) {
            float near = box.min()[axis] / p[axis], far = box.max()[axis] / p[axis];
            if (near > far) std::swap(near, far);
            from = std::max(from, near);
            to = std::min(to, far);
        }
        return from < to ? from : 1.0F;
    }
};

TEST_F(OwnBodyOf, AVehicleIsFoundAndNothingElse) {
    const Eigen::AlignedBox3f mast(Point(-2.4F, -0.7F, -0.9F), Point(-0.9F, 0.7F, 0.3F));
    const OwnBody body = found(mast);
    EXPECT_GT(body.share, 0.05);
    ASSERT_FALSE(body.boxes.empty());
    Eigen::AlignedBox3f around;
    for (const auto& box : body.boxes) around.extend(box);
    const Point margin = Point::Constant(0.3F);
    EXPECT_TRUE(Eigen::AlignedBox3f(mast.min() - margin, mast.max() + margin).contains(around))
        << around.min().transpose() << " to " << around.max().transpose();
    EXPECT_GT(around.sizes().y(), 1.2F) << "the side towards the sensor is seen";
}

TEST_F(OwnBodyOf, AStreetThereIsNone) {
    EXPECT_TRUE(found({}).boxes.empty()) << "the flat road looks alike in all scans";
}

TEST_F(OwnBodyOf, ASensorAtRestNothingIsSaid) {
    EXPECT_TRUE(found({Point(-2.4F, -0.7F, -0.9F), Point(-0.9F, 0.7F, 0.3F)}, false).boxes.empty());
}

}  // namespace own_body_test
}  // namespace dynamic_filter::io
