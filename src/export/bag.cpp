// SPDX-License-Identifier: MIT
#include "export/outputs.hpp"

#include <optional>

#include "base/output_folder.hpp"
#include "dynamic_filter/bag.hpp"
#include "geometry/kept.hpp"
#include "recording/world_records.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// Raw, static and dynamic points of each scan, or only the static or the dynamic ones, and where
/// the sensor is.
class BagSink final : public Sink {
public:
    /// `map`: a cloud in the world's frame that is written, too; not of a part of the space.
    BagSink(const fs::path& file, std::optional<fs::path> map, const ConvertOptions& o)
        : writer_(io::BagWriter::create(file)),
          encoding_(writer_->encoding()),
          map_(std::move(map)),
          keep_unknown_(o.keep_unknown),
          only_(o.only) {}

    void append(const io::FullScan& scan, const Labels& labels, const std::string&) override {
        last_ = scan.stamp;
        const io::Cloud cloud = in_sensor(scan);
        for (const io::Field& field : cloud.fields) {
            const bool wide = field.type == io::FieldType::i64 || field.type == io::FieldType::u64;
            if (wide) rounded_ = "64-bit integers are rounded to doubles";
        }
        const std::string& name = scan.sensor_name;
        const std::string frame = name.empty() ? "lidar" : name;
        write("/tf", "tf2_msgs/TFMessage", scan.stamp,
              io::transform_message(kWorld, frame, scan.T_world_sensor, scan.stamp, encoding_));
        const auto write_points = [&](const char* topic, const io::Cloud& points) {
            write((name.empty() ? "" : "/" + name) + topic, "sensor_msgs/PointCloud2", scan.stamp,
                  io::cloud_message(points, scan.stamp, frame, encoding_));
        };
        if (only_.empty()) write_points("/points", cloud);
        if (labels.empty()) return;
        if (only_ != "dynamic") write_points("/points_static", part(cloud, labels, Kept::in_map));
        if (only_ != "static") write_points("/points_dynamic", part(cloud, labels, Kept::removed));
    }
    std::string commit() override {
        if (map_) {
            write("/static_map", "sensor_msgs/PointCloud2", last_,
                  io::cloud_message(io::read_cloud(*map_), last_, kWorld, encoding_));
        }
        writer_->commit();
        return rounded_;
    }

private:
    void write(const std::string& name, const char* type, double stamp,
               const std::vector<std::byte>& message) {
        writer_->write({name, type, encoding_}, io::to_nanoseconds(stamp), message);
    }

    static constexpr const char* kWorld = "map";

    /// The record with the coordinates that the filter sees.
    static io::Cloud in_sensor(const io::FullScan& scan) {
        io::Cloud cloud = scan.cloud;
        io::FullScan local = scan;
        local.T_world_sensor = Pose::Identity();
        cloud.data = world_records(local, cloud);
        return cloud;
    }
    [[nodiscard]] io::Cloud part(const io::Cloud& cloud, const Labels& labels, Kept kept) const {
        io::Cloud result = cloud;
        result.data.clear();
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (where(labels[i], false, keep_unknown_) != kept) continue;
            append_record(result.data, cloud.data, i, cloud.point_bytes);
        }
        return result;
    }

    std::unique_ptr<io::BagWriter> writer_;
    io::MessageEncoding encoding_;
    std::optional<fs::path> map_;
    bool keep_unknown_;
    std::string only_;
    double last_ = 0.0;  // [s]
    std::string rounded_;
};

}  // namespace

std::unique_ptr<Sink> make_bag_sink(const ConvertOptions& o) {
    refuse_existing(o.output, o.overwrite);
    const fs::path map = o.labels.value_or("") / "static_map.pcd";
    const bool takes_map = o.only != "dynamic" && o.box.empty() && o.max_range == 0.0;
    return std::make_unique<BagSink>(
        o.output, o.labels && takes_map && fs::exists(map) ? std::optional(map) : std::nullopt, o);
}

}  // namespace dynamic_filter::app
