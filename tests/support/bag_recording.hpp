// SPDX-License-Identifier: MIT
/// Bags on disk that tests fill.
#pragma once

#include <cmath>
#include <memory>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {

inline Pose moved(double x, double y = 0.0, double z = 0.0) {
    return Pose(Eigen::Translation3d(x, y, z));
}

/// A bag that a test fills; scans of two points, (5 + i, 0, 0) and (0, 5, 0).
class BagFiles : public RecordingFiles {
protected:
    static constexpr double kStart = 1000.0;  // [s]
    static double stamp(std::size_t i) { return kStart + 0.1 * static_cast<double>(i); }

    void scans(std::size_t count, const std::string& frame, const std::string& topic = "/points",
               double shift = 0.0) {
        for (std::size_t i = 0; i < count; ++i) scan(i, frame, topic, stamp(i) + shift);
    }
    void scan(std::size_t i, const std::string& frame, const std::string& topic, double at) {
        Cloud cloud;
        for (const char* axis : {"x", "y", "z", "time"}) add_field(cloud, axis, FieldType::f32);
        const std::string bytes =
            floats({5.0F + static_cast<float>(i), 0, 0, 0.0F, 0, 5, 0, 0.05F});
        const auto raw = std::as_bytes(std::span(bytes));
        cloud.data.assign(raw.begin(), raw.end());
        put(cloud, frame, topic, at);
    }
    void put(const Cloud& cloud, const std::string& frame, const std::string& topic, double at) {
        write(topic, "sensor_msgs/PointCloud2", at,
              cloud_message(cloud, at, frame, MessageEncoding::cdr));
    }
    void transform(const std::string& parent, const std::string& child, const Pose& pose, double at,
                   const std::string& topic = "/tf") {
        write(topic, "tf2_msgs/TFMessage", at,
              transform_message(parent, child, pose, at, MessageEncoding::cdr));
    }
    void odometry(const std::string& parent, const std::string& child, const Pose& pose, double at,
                  const std::string& topic = "/odom") {
        write(topic, "nav_msgs/Odometry", at,
              odometry_message(parent, child, pose, at, MessageEncoding::cdr));
    }
    /// Odometry every 50 ms, 1 m a second along x.
    void drive(const std::string& parent, const std::string& child, double from = -1.0,
               double to = 2.0) {
        for (double t = from; t < to; t += 0.05) odometry(parent, child, moved(t), kStart + t);
    }
    void write(const std::string& topic, const std::string& type, double at,
               const std::vector<std::byte>& message) {
        writer_->write({topic, type, MessageEncoding::cdr}, to_nanoseconds(at), message);
    }
    Recording opened(const OpenOptions& options = {}) {
        if (writer_) writer_->commit();
        writer_.reset();
        return open_recording(data / "a.mcap", options);
    }
    template <class E = InputError>
    std::string failure(const OpenOptions& options = {}) {
        return error_of<E>([&] { (void)opened(options); });
    }
    std::unique_ptr<BagWriter> writer_ = BagWriter::create(data / "a.mcap");
};

}  // namespace dynamic_filter::io
