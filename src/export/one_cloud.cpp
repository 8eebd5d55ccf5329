// SPDX-License-Identifier: MIT
#include "export/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/little_endian.hpp"
#include "base/output_folder.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/georeference.hpp"
#include "export/normals.hpp"
#include "export/places.hpp"
#include "export/thinned_records.hpp"
#include "navigation/survey.hpp"
#include "recording/scans.hpp"
#include "recording/world_records.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

constexpr const char* kClass = "classification";
constexpr std::uint8_t kUnassigned = 1, kGround = 2, kMoving = 22;  // of LAS
// What counts as ground: where a vehicle could go over kerbs, and how far from it its points are.
constexpr Robot kVehicle{.height = 1.0F, .step = 0.3F};
constexpr double kGroundCell = 0.2, kGroundNoise = 0.1;  // [m]

/// All points in the world's frame, in one file, or the nearest one of each cell; a field
/// `dynamic` says what moves.
class CloudSink final : public Sink {
public:
    explicit CloudSink(const ConvertOptions& o)
        : file_(o.output),
          sensor_(o.sensor),
          normal_radius_(o.normals ? std::max(0.3, 3.0 * o.thin) : 0.0),
          moving_class_(static_cast<std::uint8_t>(o.moving_class.value_or(kMoving))) {
        if (o.thin > 0.0) thinned_.emplace(o.thin);
        if (o.ground) survey_.emplace(kGroundCell);
        is_classified_ = o.ground || o.moving_class.has_value();
        if (o.crs.empty()) return;
        refuse_existing(path_file(), o.overwrite);
        georeference_.emplace(o.crs, o.origin);
    }

    void append(const io::FullScan& scan, const Labels& labels, const std::string&) override {
        if (layout_.fields.empty()) begin(scan, !labels.empty());
        refuse_other_fields(scan, layout_);
        if (georeference_) {
            path_.push_back(georeference_->places({scan.T_world_sensor * sensor_}).front());
            stamps_.push_back(scan.stamp);
        }
        if (survey_) add_surfaces(scan, labels);
        const auto records = world_records(scan, layout_);
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            if (!is_measured(scan.points[i])) {
                ++unmeasured_;
                continue;
            }
            const bool moves = is_dynamic(labels, i);
            const Eigen::Vector3d to_sensor = sensor_ - scan.points[i].cast<double>();
            std::vector<std::byte>& to = thinned_ ? record_ : map_.data;
            record_.clear();
            append_record(to, records, i, layout_.point_bytes);
            if (!labels.empty()) to.push_back(std::byte{moves});
            if (is_classified_) to.push_back(std::byte{moves ? moving_class_ : kUnassigned});
            if (normal_radius_ > 0.0) {
                const Eigen::Vector3f direction =
                    (scan.T_world_sensor.linear() * to_sensor).cast<float>();
                for (const float value : direction) put(to, value);
            }
            if (!thinned_) continue;
            thinned_->add(scan.T_world_sensor * scan.points[i].cast<double>(),
                          static_cast<float>(to_sensor.norm()), moves, record_);
        }
    }
    std::string commit() override {
        if (thinned_) map_.data = thinned_->records();
        if (normal_radius_ > 0.0) fit_normals(map_, normal_names(file_), normal_radius_);
        std::string loss = "left out: poses, stamps, and where a scan ends";
        if (unmeasured_ > 0)
            loss += fmt::format(", {} points that are no measurement", unmeasured_);
        if (survey_) loss += classify_ground();
        if (georeference_) {
            if (normal_radius_ > 0.0 && map_.size() > 0) {
                turn_normals(map_, normal_names(file_), georeference_->turn_at(origin_of(map_)));
            }
            map_ = georeference_->cloud(map_);
        }
        const std::string by_format = io::write_cloud(file_, map_).loss;
        if (georeference_) io::write_file(path_file(), path_as_text());
        return by_format.empty() ? loss : loss + "; " + by_format;
    }

private:
    void begin(const io::FullScan& scan, bool has_labels) {
        layout_ = layout_of(scan, false);
        map_.fields = layout_.fields;
        map_.point_bytes = layout_.point_bytes;
        if (has_labels) io::add_field(map_, "dynamic", io::FieldType::u8);
        if (is_classified_) {
            refuse_field_twice(kClass, "--ground and --moving-class");
            io::add_field(map_, kClass, io::FieldType::u8);
        }
        if (normal_radius_ == 0.0) return;
        for (const std::string& name : normal_names(file_)) {
            refuse_field_twice(name, "--normals");
            io::add_field(map_, name, io::FieldType::f32);
        }
    }
    void refuse_field_twice(const std::string& name, const std::string& option) const {
        if (map_.find(name) == nullptr) return;
        throw ConfigError(option + ": the scans have a field " + name + " already");
    }
    /// The survey follows the sensor, which may be elsewhere than the origin of the scans.
    void add_surfaces(const io::FullScan& scan, const Labels& labels) {
        Points from_sensor = scan.points;
        for (Point& point : from_sensor) {
            if (is_measured(point)) point -= sensor_.cast<float>();
        }
        survey_->add_surfaces(from_sensor,
                              labels.empty() ? Labels(scan.points.size(), Label::static_) : labels,
                              scan.T_world_sensor * Eigen::Translation3d(sensor_));
    }
    /// Returns a note if there is no ground.
    std::string classify_ground() {
        const Ground ground = survey_->ground(kVehicle);
        if (std::all_of(ground.height.begin(), ground.height.end(),
                        [](float height) { return std::isnan(height); })) {
            return "; no ground was seen below the sensor, so nothing has class 2";
        }
        const std::size_t offset = map_.find(kClass)->offset;
        const std::vector<Eigen::Vector3d> places = places_of(map_);
        for (std::size_t i = 0; i < places.size(); ++i) {
            std::byte& kind = map_.data[i * map_.point_bytes + offset];
            if (kind != std::byte{kUnassigned} || !ground.is_near(places[i], kGroundNoise))
                continue;
            kind = std::byte{kGround};
        }
        return "";
    }
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
    double normal_radius_;    // [m]; 0: no normals
    std::uint8_t moving_class_;
    bool is_classified_ = false;
    std::optional<Georeference> georeference_;
    std::vector<Eigen::Vector3d> path_;  // of the sensor, in the coordinate system
    std::vector<double> stamps_;         // [s]
    io::Cloud layout_, map_;
    std::optional<ThinnedRecords> thinned_;  // by the distance from the sensor
    std::vector<std::byte> record_;          // of one point
    std::optional<Survey> survey_;           // for the ground
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
