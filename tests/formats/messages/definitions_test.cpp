// SPDX-License-Identifier: MIT
#include "formats/messages/definitions.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace definitions_test {

TEST(Definitions, HoldAllTypesOfTheMessage) {
    const std::string ros1 = full_definition("nav_msgs/Odometry", MessageEncoding::ros1);
    const std::string ros2 = full_definition("nav_msgs/Odometry", MessageEncoding::cdr);
    EXPECT_HAS(ros1, "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\n");
    EXPECT_HAS(ros2, "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
    for (const char* type : {"PoseWithCovariance", "Twist", "Vector3", "Point", "Quaternion"}) {
        EXPECT_HAS(ros1, std::string("\nMSG: geometry_msgs/") + type + "\n");
    }
    EXPECT_EQ(ros2_type("nav_msgs/Odometry"), "nav_msgs/msg/Odometry");
}

}  // namespace definitions_test
}  // namespace dynamic_filter::io
