// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <set>

#include "commands.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/bag.hpp"
#include "dynamic_filter/io/bag_writer.hpp"
#include "dynamic_filter/io/messages.hpp"
#include "dynamic_filter/io/writers.hpp"
#include "frames.hpp"
#include "map_files.hpp"
#include "output_folder.hpp"
#include "progress.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// What is written scan by scan.
class Sink {
public:
    Sink() = default;
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;
    virtual ~Sink() = default;
    /// `labels` are verdicts or ground truth, empty if there are none.
    virtual void append(const io::Frame& frame, const Labels& labels) = 0;
    virtual void commit() = 0;
};

/// What a format could not hold.
void say(const std::string& loss) {
    if (!loss.empty()) fmt::print(stderr, "note: {}\n", loss);
}

bool is_dynamic(const Labels& labels, std::size_t i) {
    return !labels.empty() && labels[i] == Label::dynamic;
}

void append_record(std::vector<std::byte>& to, std::span<const std::byte> records, std::size_t i,
                   std::size_t bytes) {
    const auto record = records.subspan(i * bytes, bytes);
    to.insert(to.end(), record.begin(), record.end());
}

/// SemanticKITTI's layout; poses are the LiDAR's.
class KittiSink final : public Sink {
public:
    KittiSink(const fs::path& folder, bool overwrite)
        : output_(folder, Contents::recording, replaced_if(overwrite)),
          scans_(output_.subfolder("velodyne")) {}

    void append(const io::Frame& frame, const Labels& labels) override {
        const std::string name = fmt::format("{:06}", poses_.size());
        io::write_bin(scans_ / (name + ".bin"), frame.points, intensities(frame.cloud));
        if (!labels.empty()) {
            io::write_labels(output_.subfolder("labels") / (name + ".label"), labels);
        }
        poses_.push_back(frame.T_world_sensor);
        stamps_.push_back(frame.stamp);
    }
    void commit() override {
        io::write_poses_kitti(output_.path() / "poses.txt", poses_);
        io::write_times(output_.path() / "times.txt", stamps_);
        output_.commit();
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

    void append(const io::Frame& frame, const Labels& labels) override {
        io::Cloud cloud = layout_;
        cloud.data.resize(frame.points.size() * cloud.point_bytes);
        const Points world = shifted_world(frame, Eigen::Vector3d::Zero());
        for (std::size_t i = 0; i < world.size(); ++i) {
            const std::array record{world[i].x(), world[i].y(), world[i].z(),
                                    is_dynamic(labels, i) ? 1.0F : 0.0F};
            std::memcpy(cloud.data.data() + i * sizeof record, record.data(), sizeof record);
        }
        cloud.viewpoint = frame.T_world_sensor;
        io::write_pcd(scans_ / fmt::format("{:06}.pcd", count_++), cloud);
        truth_.data.insert(truth_.data.end(), cloud.data.begin(), cloud.data.end());
        labelled_ = labelled_ && !labels.empty();
    }
    /// With labels, the map that the benchmark scores against.
    void commit() override {
        truth_.fields = layout_.fields;
        truth_.point_bytes = layout_.point_bytes;
        if (labelled_) io::write_pcd(output_.path() / "gt_cloud.pcd", truth_);
        output_.commit();
    }

private:
    OutputFolder output_;
    fs::path scans_;
    io::Cloud layout_, truth_;
    std::size_t count_ = 0;
    bool labelled_ = true;
};

/// Raw, static and dynamic points of each scan, and where the sensor is.
class BagSink final : public Sink {
public:
    /// `map`: a cloud in the world's frame that is written, too.
    BagSink(const fs::path& file, std::optional<fs::path> map)
        : writer_(io::BagWriter::create(file)),
          encoding_(writer_->encoding()),
          map_(std::move(map)) {}

    void append(const io::Frame& frame, const Labels& labels) override {
        last_ = frame.stamp;
        const io::Cloud cloud = in_sensor(frame);
        write("/tf", "tf2_msgs/TFMessage", frame.stamp,
              io::transform_message(kWorld, kSensor, frame.T_world_sensor, frame.stamp, encoding_));
        const auto write_points = [&](const char* name, const io::Cloud& points) {
            write(name, "sensor_msgs/PointCloud2", frame.stamp,
                  io::cloud_message(points, frame.stamp, kSensor, encoding_));
        };
        write_points("/points", cloud);
        if (labels.empty()) return;
        write_points("/points_static", part(cloud, labels, Label::still));
        write_points("/points_dynamic", part(cloud, labels, Label::dynamic));
    }
    void commit() override {
        if (map_) {
            write("/static_map", "sensor_msgs/PointCloud2", last_,
                  io::cloud_message(io::read_cloud(*map_), last_, kWorld, encoding_));
        }
        writer_->commit();
    }

private:
    void write(const char* name, const char* type, double stamp,
               const std::vector<std::byte>& message) {
        writer_->write({name, type, encoding_}, io::to_nanoseconds(stamp), message);
    }

    static constexpr const char *kWorld = "map", *kSensor = "lidar";

    /// The record with the coordinates that the filter sees.
    static io::Cloud in_sensor(const io::Frame& frame) {
        io::Cloud cloud = frame.cloud;
        io::Frame local = frame;
        local.T_world_sensor = Pose::Identity();
        cloud.data = world_records(local, cloud);
        return cloud;
    }
    static io::Cloud part(const io::Cloud& cloud, const Labels& labels, Label label) {
        io::Cloud result = cloud;
        result.data.clear();
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (labels[i] == label) append_record(result.data, cloud.data, i, cloud.point_bytes);
        }
        return result;
    }

    std::unique_ptr<io::BagWriter> writer_;
    io::MessageEncoding encoding_;
    std::optional<fs::path> map_;
    double last_ = 0.0;  // [s]
};

/// All points in the world's frame, in one file; a field `dynamic` says what moves.
class MapSink final : public Sink {
public:
    explicit MapSink(fs::path file) : file_(std::move(file)) {}

    void append(const io::Frame& frame, const Labels& labels) override {
        if (layout_.fields.empty()) {
            layout_ = layout_of(frame, false);
            map_.fields = layout_.fields;
            map_.point_bytes = layout_.point_bytes;
            if (!labels.empty()) io::add_field(map_, "dynamic", io::FieldType::u8);
        }
        const auto records = world_records(frame, layout_);
        for (std::size_t i = 0; i < frame.points.size(); ++i) {
            if (!is_measured(frame.points[i])) continue;
            append_record(map_.data, records, i, layout_.point_bytes);
            if (map_.point_bytes == layout_.point_bytes) continue;
            map_.data.push_back(is_dynamic(labels, i) ? std::byte{1} : std::byte{0});
        }
    }
    void commit() override { say(io::write_cloud(file_, map_)); }

private:
    fs::path file_;
    io::Cloud layout_, map_;
};

void refuse_existing(const ConvertOptions& o) {
    if (fs::exists(o.output) && !o.overwrite) {
        throw ConfigError(o.output.string() + ": exists; choose another, or --overwrite");
    }
}

/// Before hours of reading, not after.
void check_cloud_output(const ConvertOptions& o) {
    static const std::set<std::string> clouds = {".pcd", ".ply", ".las", ".npy", ".bin"};
    if (!clouds.contains(o.output.extension().string())) {
        throw ConfigError(
            fmt::format("{}: unknown extension; expected {}, .mcap, .bag, .db3, or "
                        "none for a folder",
                        o.output.string(), fmt::join(clouds, ", ")));
    }
    refuse_existing(o);
}

std::unique_ptr<Sink> make_sink(const ConvertOptions& o) {
    static const std::set<std::string> bags = {".mcap", ".bag", ".db3"};
    const std::string extension = o.output.extension().string();
    if (o.to == "benchmark") return std::make_unique<BenchmarkSink>(o.output, o.overwrite);
    if (o.to == "kitti" || extension.empty()) {
        return std::make_unique<KittiSink>(o.output, o.overwrite);
    }
    if (bags.contains(extension)) {
        refuse_existing(o);
        const fs::path map = o.labels.value_or("") / "static_map.pcd";
        return std::make_unique<BagSink>(
            o.output, o.labels && fs::exists(map) ? std::optional(map) : std::nullopt);
    }
    check_cloud_output(o);
    return std::make_unique<MapSink>(o.output);
}

/// Of a run, or the recording's own truth.
Labels labels_of(const ConvertOptions& o, const io::Sequence& sequence, std::size_t i,
                 const io::Frame& frame) {
    if (!o.labels) return frame.truth;
    const fs::path folder =
        fs::is_directory(*o.labels / "labels") ? *o.labels / "labels" : *o.labels;
    Labels labels = io::read_labels(folder / (io::stem(sequence, i) + ".label"));
    if (labels.size() == frame.points.size()) return labels;
    throw ConfigError(
        fmt::format("{}: {} labels for the {} points of scan {}; are they of another "
                    "recording?",
                    folder.string(), labels.size(), frame.points.size(), io::stem(sequence, i)));
}

int convert_recording(const ConvertOptions& o) {
    if (o.to == "autoware")
        throw ConfigError("--to autoware is for a map: give a cloud file as IN");
    const io::Sequence sequence = open(o.data);
    for (const std::string& note : sequence.notes) fmt::print(stderr, "note: {}\n", note);
    catch_interrupts();
    const std::unique_ptr<Sink> sink = make_sink(o);
    std::vector<std::size_t> scans(sequence.size());
    std::iota(scans.begin(), scans.end(), 0U);
    Progress progress("convert", scans.size());
    std::size_t rejected = 0;
    for_each_frame(sequence, scans, {}, [&](std::size_t i, MaybeFrame& maybe) {
        progress.advance();
        if (interrupted()) return false;
        if (!maybe.frame) {
            fmt::print(stderr, "rejected {}\n", maybe.error);
            ++rejected;
            return true;
        }
        sink->append(*maybe.frame, labels_of(o, sequence, i, *maybe.frame));
        return true;
    });
    if (interrupted()) return kInterrupted;  // nothing is put in place
    if (rejected == scans.size()) throw InputError(o.data.data, "", "no scan is usable");
    sink->commit();
    fmt::print("written  {} ({} scans)\n", o.output.string(), scans.size() - rejected);
    return rejected == 0 ? kDone : kRejected;
}

/// Autoware's map tiles: squares of the ground, each a PCD, and where its lower corner is.
int write_tiles(const io::Cloud& cloud, const ConvertOptions& o) {
    constexpr int kTile = 20;  // [m]
    OutputFolder output(o.output, Contents::tiles, replaced_if(o.overwrite));
    const auto x = io::values(cloud, *cloud.find("x")), y = io::values(cloud, *cloud.find("y"));
    std::map<std::pair<int, int>, io::Cloud> tiles;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
        const auto corner = [](double v) {
            return kTile * static_cast<int>(std::floor(v / kTile));
        };
        io::Cloud& tile = tiles[{corner(x[i]), corner(y[i])}];
        tile.fields = cloud.fields;
        tile.point_bytes = cloud.point_bytes;
        append_record(tile.data, cloud.data, i, cloud.point_bytes);
    }
    const fs::path folder = output.subfolder("pointcloud_map");
    std::string metadata = fmt::format("x_resolution: {0}.0\ny_resolution: {0}.0\n", kTile);
    for (const auto& [corner, tile] : tiles) {
        const std::string name = fmt::format("{}_{}.pcd", corner.first, corner.second);
        io::write_pcd(folder / name, tile);
        metadata += fmt::format("{}: [{}, {}]\n", name, corner.first, corner.second);
    }
    io::write_file(output.path() / "pointcloud_map_metadata.yaml", metadata);
    output.commit();
    fmt::print("written  {} ({} tiles)\n", output.name().string(), tiles.size());
    return kDone;
}

int convert_cloud(const ConvertOptions& o) {
    if (o.to == "autoware") return write_tiles(io::read_cloud(o.data.data), o);
    check_cloud_output(o);
    const io::Cloud cloud = io::read_cloud(o.data.data);
    say(io::write_cloud(o.output, cloud));
    fmt::print("written  {} ({} points)\n", o.output.string(), cloud.size());
    return kDone;
}

}  // namespace

int convert(const ConvertOptions& o) {
    std::error_code ignored;
    if (fs::equivalent(o.data.data, o.output, ignored)) {
        throw ConfigError(o.output.string() + ": is the input itself; choose another output");
    }
    const fs::path folder = fs::weakly_canonical(fs::absolute(o.output)).parent_path();
    for (fs::path above = folder; above.has_relative_path(); above = above.parent_path()) {
        if (fs::is_directory(o.data.data, ignored) && fs::equivalent(above, o.data.data, ignored)) {
            throw ConfigError(o.output.string() + ": lies within the recording; choose another");
        }
    }
    const bool recording =
        fs::is_directory(o.data.data, ignored) || io::Bag::recognises(o.data.data);
    return recording ? convert_recording(o) : convert_cloud(o);
}

}  // namespace dynamic_filter::app
