// SPDX-License-Identifier: MIT
#include "export/outputs.hpp"

#include <fmt/format.h>

#include <optional>

#include "base/output_folder.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/georeference.hpp"
#include "export/thinned_records.hpp"
#include "recording/world_records.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// All points in the world's frame, in one file, or the nearest one of each cell; a field
/// `dynamic` says what moves.
class CloudSink final : public Sink {
public:
    explicit CloudSink(const ConvertOptions& o) : file_(o.output), sensor_(o.sensor) {
        if (o.thin > 0.0) thinned_.emplace(o.thin);
        if (o.crs.empty()) return;
        refuse_existing(path_file(), o.overwrite);
        georeference_.emplace(o.crs, o.origin);
    }

    void append(const io::FullScan& scan, const Labels& labels, const std::string&) override {
        if (layout_.fields.empty()) {
            layout_ = layout_of(scan, false);
            map_.fields = layout_.fields;
            map_.point_bytes = layout_.point_bytes;
            if (!labels.empty()) io::add_field(map_, "dynamic", io::FieldType::u8);
        }
        if (georeference_) {
            path_.push_back(georeference_->places({scan.T_world_sensor * sensor_}).front());
            stamps_.push_back(scan.stamp);
        }
        const auto records = world_records(scan, layout_);
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            if (!is_measured(scan.points[i])) {
                ++unmeasured_;
                continue;
            }
            const bool moves = is_dynamic(labels, i);
            std::vector<std::byte>& to = thinned_ ? record_ : map_.data;
            record_.clear();
            append_record(to, records, i, layout_.point_bytes);
            if (map_.point_bytes != layout_.point_bytes) to.push_back(std::byte{moves});
            if (!thinned_) continue;
            thinned_->add(scan.T_world_sensor * scan.points[i].cast<double>(),
                          static_cast<float>((scan.points[i].cast<double>() - sensor_).norm()),
                          moves, record_);
        }
    }
    std::string commit() override {
        if (thinned_) map_.data = thinned_->records();
        std::string loss = "left out: poses, stamps, and where a scan ends";
        if (unmeasured_ > 0)
            loss += fmt::format(", {} points that are no measurement", unmeasured_);
        if (georeference_) map_ = georeference_->cloud(map_);
        const std::string by_format = io::write_cloud(file_, map_).loss;
        if (georeference_) io::write_file(path_file(), path_as_text());
        return by_format.empty() ? loss : loss + "; " + by_format;
    }

private:
    /// Beside the cloud: where the sensor was, in the same coordinates.
    [[nodiscard]] fs::path path_file() const {
        return fs::path(file_).replace_filename(file_.stem().string() + "_path.csv");
    }
    [[nodiscard]] std::string path_as_text() const {
        std::string text = "time,x,y,z\n";
        for (std::size_t i = 0; i < path_.size(); ++i) {
            text += fmt::format("{:.9f},{:.4f},{:.4f},{:.4f}\n", stamps_[i], path_[i].x(),
                                path_[i].y(), path_[i].z());
        }
        return text;
    }

    fs::path file_;
    Eigen::Vector3d sensor_;  // [m] in the frame of the scans
    std::optional<Georeference> georeference_;
    std::vector<Eigen::Vector3d> path_;  // of the sensor, in the coordinate system
    std::vector<double> stamps_;         // [s]
    io::Cloud layout_, map_;
    std::optional<ThinnedRecords> thinned_;  // by the distance from the sensor
    std::vector<std::byte> record_;          // of one point
    std::size_t unmeasured_ = 0;
};

}  // namespace

void check_cloud_output(const ConvertOptions& o) {
    if (!io::can_write_cloud(o.output)) {  // before hours of reading, not after
        throw ConfigError(
            fmt::format("{}: unknown extension; expected {}, .mcap, .bag, .db3, .bt, .ot, "
                        "or none for a folder",
                        o.output.string(), io::cloud_kinds_written()));
    }
    refuse_existing(o.output, o.overwrite);
}

std::unique_ptr<Sink> make_cloud_sink(const ConvertOptions& o) {
    check_cloud_output(o);
    return std::make_unique<CloudSink>(o);
}

}  // namespace dynamic_filter::app
