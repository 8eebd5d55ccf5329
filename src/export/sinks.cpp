// SPDX-License-Identifier: MIT
#include "export/sinks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstring>
#include <set>

#include "base/output_folder.hpp"
#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/label_files.hpp"
#include "geometry/kept.hpp"
#include "recording/scans.hpp"
#include "recording/world_records.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

bool is_dynamic(const Labels& labels, std::size_t i) {
    return !labels.empty() && labels[i] == Label::dynamic;
}

/// "left out: a, b", of what a scan has and its format has no place for.
std::string left_out(const std::vector<io::Field>& fields, std::set<std::string> kept,
                     const std::string& also = "") {
    std::vector<std::string> names;
    for (const io::Field& field : fields) {
        if (!kept.contains(field.name)) names.push_back(field.name);
    }
    if (!also.empty()) names.push_back(also);
    return names.empty() ? "" : fmt::format("left out: {}", fmt::join(names, ", "));
}

/// SemanticKITTI's layout; poses are the LiDAR's.
class KittiSink final : public Sink {
public:
    KittiSink(const fs::path& folder, bool overwrite)
        : output_(folder, Contents::recording, replaced_if(overwrite)),
          scans_(output_.subfolder("velodyne")) {}

    void append(const io::FullScan& scan, const Labels& labels) override {
        const std::string name = fmt::format("{:06}", poses_.size());
        fields_ = scan.cloud.fields;
        io::write_bin(scans_ / (name + ".bin"), scan.points, intensities(scan.cloud));
        if (!labels.empty()) {
            io::write_labels(io::label_file(output_.subfolder("labels"), name), labels);
        }
        poses_.push_back(scan.T_world_sensor);
        stamps_.push_back(scan.stamp);
    }
    std::string commit() override {
        io::write_poses_kitti(output_.path() / "poses.txt", poses_);
        io::write_times(output_.path() / "times.txt", stamps_);
        output_.commit();
        return left_out(fields_, {"x", "y", "z", "intensity"});
    }

private:
    static std::vector<float> intensities(const io::Cloud& cloud) {
        const io::Field* field = cloud.find("intensity");
        if (field == nullptr) return std::vector<float>(cloud.size());
        const auto values = io::values(cloud, *field);
        return {values.begin(), values.end()};
    }

    OutputFolder output_;
    fs::path scans_;
    std::vector<io::Field> fields_;
    std::vector<Pose> poses_;
    std::vector<double> stamps_;
};

/// DynamicMap_Benchmark's layout: points in the world, pose in VIEWPOINT, truth in the intensity.
class BenchmarkSink final : public Sink {
public:
    BenchmarkSink(const fs::path& folder, bool overwrite)
        : output_(folder, Contents::benchmark, replaced_if(overwrite)),
          scans_(output_.subfolder("pcd")) {
        for (const char* name : {"x", "y", "z", "intensity"}) {
            io::add_field(layout_, name, io::FieldType::f32);
        }
    }

    void append(const io::FullScan& scan, const Labels& labels) override {
        io::Cloud cloud = layout_;
        fields_ = scan.cloud.fields;
        cloud.data.resize(scan.points.size() * cloud.point_bytes);
        const Points world = shifted_world(scan, Eigen::Vector3d::Zero());
        for (std::size_t i = 0; i < world.size(); ++i) {
            const std::array record{world[i].x(), world[i].y(), world[i].z(),
                                    is_dynamic(labels, i) ? 1.0F : 0.0F};
            std::memcpy(cloud.data.data() + i * sizeof record, record.data(), sizeof record);
        }
        cloud.viewpoint = scan.T_world_sensor;
        io::write_pcd(scans_ / fmt::format("{:06}.pcd", count_++), cloud);
        truth_.data.insert(truth_.data.end(), cloud.data.begin(), cloud.data.end());
        labelled_ = labelled_ && !labels.empty();
    }
    /// Writes the map that the benchmark scores against, if there are labels.
    std::string commit() override {
        truth_.fields = layout_.fields;
        truth_.point_bytes = layout_.point_bytes;
        if (labelled_) io::write_pcd(output_.path() / "gt_cloud.pcd", truth_);
        output_.commit();
        return left_out(fields_, {"x", "y", "z"}, "stamps") +
               "; coordinates are rounded to float32 in the world's frame";
    }

private:
    OutputFolder output_;
    fs::path scans_;
    io::Cloud layout_, truth_;
    std::vector<io::Field> fields_;
    std::size_t count_ = 0;
    bool labelled_ = true;
};

/// Raw, static and dynamic points of each scan, and where the sensor is.
class BagSink final : public Sink {
public:
    /// `map`: a cloud in the world's frame that is written, too.
    BagSink(const fs::path& file, std::optional<fs::path> map, bool keep_unknown)
        : writer_(io::BagWriter::create(file)),
          encoding_(writer_->encoding()),
          map_(std::move(map)),
          keep_unknown_(keep_unknown) {}

    void append(const io::FullScan& scan, const Labels& labels) override {
        last_ = scan.stamp;
        const io::Cloud cloud = in_sensor(scan);
        for (const io::Field& field : cloud.fields) {
            const bool wide = field.type == io::FieldType::i64 || field.type == io::FieldType::u64;
            if (wide) rounded_ = "64-bit integers are rounded to doubles";
        }
        write("/tf", "tf2_msgs/TFMessage", scan.stamp,
              io::transform_message(kWorld, kSensor, scan.T_world_sensor, scan.stamp, encoding_));
        const auto write_points = [&](const char* name, const io::Cloud& points) {
            write(name, "sensor_msgs/PointCloud2", scan.stamp,
                  io::cloud_message(points, scan.stamp, kSensor, encoding_));
        };
        write_points("/points", cloud);
        if (labels.empty()) return;
        write_points("/points_static", only(cloud, labels, Kept::in_map));
        write_points("/points_dynamic", only(cloud, labels, Kept::removed));
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
    void write(const char* name, const char* type, double stamp,
               const std::vector<std::byte>& message) {
        writer_->write({name, type, encoding_}, io::to_nanoseconds(stamp), message);
    }

    static constexpr const char *kWorld = "map", *kSensor = "lidar";

    /// The record with the coordinates that the filter sees.
    static io::Cloud in_sensor(const io::FullScan& scan) {
        io::Cloud cloud = scan.cloud;
        io::FullScan local = scan;
        local.T_world_sensor = Pose::Identity();
        cloud.data = world_records(local, cloud);
        return cloud;
    }
    [[nodiscard]] io::Cloud only(const io::Cloud& cloud, const Labels& labels, Kept kept) const {
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
    double last_ = 0.0;  // [s]
    std::string rounded_;
};

/// All points in the world's frame, in one file; a field `dynamic` says what moves.
class MapSink final : public Sink {
public:
    explicit MapSink(fs::path file) : file_(std::move(file)) {}

    void append(const io::FullScan& scan, const Labels& labels) override {
        if (layout_.fields.empty()) {
            layout_ = layout_of(scan, false);
            map_.fields = layout_.fields;
            map_.point_bytes = layout_.point_bytes;
            if (!labels.empty()) io::add_field(map_, "dynamic", io::FieldType::u8);
        }
        const auto records = world_records(scan, layout_);
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            if (!is_measured(scan.points[i])) {
                ++unmeasured_;
                continue;
            }
            append_record(map_.data, records, i, layout_.point_bytes);
            if (map_.point_bytes == layout_.point_bytes) continue;
            map_.data.push_back(is_dynamic(labels, i) ? std::byte{1} : std::byte{0});
        }
    }
    std::string commit() override {
        std::string loss = "left out: poses, stamps, and where a scan ends";
        if (unmeasured_ > 0)
            loss += fmt::format(", {} points that are no measurement", unmeasured_);
        const std::string by_format = io::write_cloud(file_, map_).loss;
        return by_format.empty() ? loss : loss + "; " + by_format;
    }

private:
    fs::path file_;
    io::Cloud layout_, map_;
    std::size_t unmeasured_ = 0;
};

}  // namespace

void append_record(std::vector<std::byte>& to, std::span<const std::byte> records, std::size_t i,
                   std::size_t bytes) {
    const auto record = records.subspan(i * bytes, bytes);
    to.insert(to.end(), record.begin(), record.end());
}

void check_cloud_output(const ConvertOptions& o) {
    if (!io::can_write_cloud(o.output)) {  // before hours of reading, not after
        throw ConfigError(
            fmt::format("{}: unknown extension; expected {}, .mcap, .bag, .db3, or "
                        "none for a folder",
                        o.output.string(), io::cloud_kinds_written()));
    }
    refuse_existing(o.output, o.overwrite);
}

std::unique_ptr<Sink> make_sink(const ConvertOptions& o) {
    if (o.to == "benchmark") return std::make_unique<BenchmarkSink>(o.output, o.overwrite);
    if (o.to == "kitti" || o.output.extension().empty()) {
        return std::make_unique<KittiSink>(o.output, o.overwrite);
    }
    if (io::BagWriter::recognises(o.output)) {
        refuse_existing(o.output, o.overwrite);
        const fs::path map = o.labels.value_or("") / "static_map.pcd";
        return std::make_unique<BagSink>(
            o.output, o.labels && fs::exists(map) ? std::optional(map) : std::nullopt,
            o.keep_unknown);
    }
    check_cloud_output(o);
    return std::make_unique<MapSink>(o.output);
}

}  // namespace dynamic_filter::app
