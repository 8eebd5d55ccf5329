// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "arena/twin.hpp"
#include "base/degree.hpp"
#include "base/json_vector.hpp"
#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/messages/messages.hpp"
#include "recording/folders.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The boxes around the dynamic points of each thing in a scan, in the frame of `T`.
std::map<std::uint16_t, Eigen::AlignedBox3d> boxes_in(const sim::SimulatedScan& scan,
                                                      const Pose& T) {
    std::map<std::uint16_t, Eigen::AlignedBox3d> boxes;
    for (std::size_t p = 0; p < scan.points.size(); ++p) {
        if (scan.labels[p] != Label::dynamic) continue;
        boxes[scan.instances[p]].extend(T * scan.points[p].cast<double>());
    }
    return boxes;
}

// nuScenes.

/// The tables of the data set, as far as they hold anything of a LiDAR.
class NuscenesTables {
public:
    explicit NuscenesTables(fs::path folder) : folder_(std::move(folder)) {
        for (const char* name : kNames) {
            const fs::path file = folder_ / (std::string(name) + ".json");
            tables_[name] = io::present(file) ? ordered_json::parse(io::read_file(file))
                                              : ordered_json::array();
        }
    }
    ordered_json& operator[](const std::string& name) { return tables_.at(name); }
    void write() const {
        fs::create_directories(folder_);
        for (const auto& [name, rows] : tables_) {
            io::write_file(folder_ / (name + ".json"), rows.dump(0) + "\n");
        }
    }

private:
    static constexpr std::array kNames{
        "attribute", "calibrated_sensor", "category",    "ego_pose", "instance", "log",       "map",
        "sample",    "sample_annotation", "sample_data", "scene",    "sensor",   "visibility"};
    fs::path folder_;
    std::map<std::string, ordered_json> tables_;
};

ordered_json rotation_of(const Pose& pose) {
    const Eigen::Quaterniond q(pose.linear());
    return {q.w(), q.x(), q.y(), q.z()};
}

/// Boxes are axis-aligned in the world, from the points of each thing.
void add_annotations(NuscenesTables& tables, const std::string& sample,
                     const sim::SimulatedScan& scan, const std::string& scene) {
    for (const auto& [thing, box] : boxes_in(scan, scan.T_world_sensor)) {
        const std::string instance = fmt::format("{}-person-{}", scene, thing);
        const Eigen::Vector3d size = box.sizes().array() + 0.02;
        tables["sample_annotation"].push_back({{"token", fmt::format("{}-{}", sample, thing)},
                                               {"sample_token", sample},
                                               {"instance_token", instance},
                                               {"visibility_token", "4"},
                                               {"attribute_tokens", {"pedestrian.moving"}},
                                               {"translation", array_of(box.center())},
                                               {"size", {size.y(), size.x(), size.z()}},
                                               {"rotation", {1.0, 0.0, 0.0, 0.0}},
                                               {"prev", ""},
                                               {"next", ""},
                                               {"num_lidar_pts", 1},
                                               {"num_radar_pts", 0}});
    }
}

// KITTI's raw drives.

constexpr const char* kDay = "2011_09_26";

/// One row of oxts: where the inertial unit is, and zeros for what nobody reads.
std::string oxts_of(const Pose& T_world_imu, const Pose& first) {
    constexpr double earth = 6378137.0, latitude = 49.0, longitude = 8.4;  // [m], [deg]
    const double scale = earth * std::cos(latitude * io::kDegree);
    const Eigen::Vector3d moved = T_world_imu.translation() - first.translation();
    const double lat =
        std::atan(std::sinh(std::asinh(std::tan(latitude * io::kDegree)) + moved.y() / scale));
    const Eigen::Matrix3d R = T_world_imu.linear();
    std::string row = fmt::format("{:.12f} {:.12f} {:.6f} {:.12f} {:.12f} {:.12f}",
                                  lat / io::kDegree, longitude + moved.x() / scale / io::kDegree,
                                  T_world_imu.translation().z(), std::atan2(R(2, 1), R(2, 2)),
                                  std::asin(-R(2, 0)), std::atan2(R(1, 0), R(0, 0)));
    for (int zero = 0; zero < 24; ++zero) row += " 0";
    return row + "\n";
}

std::string raw_stamp(std::size_t scan) {
    return fmt::format("{} 13:02:{:02}.{}00000000\n", "2011-09-26", scan / 10 % 60, scan % 10);
}

/// The boxes of a thing while it was in view without a gap, in the frame of the sensor.
struct TwinTrack {
    std::size_t first = 0;
    std::vector<Eigen::AlignedBox3d> boxes;
    [[nodiscard]] Eigen::Vector3d size() const {
        Eigen::Vector3d largest = Eigen::Vector3d::Zero();
        for (const auto& box : boxes) largest = largest.cwiseMax(box.sizes());
        return largest;
    }
};

std::vector<TwinTrack> tracks_of(const std::vector<sim::SimulatedScan>& scans) {
    std::vector<TwinTrack> tracks;
    std::map<std::uint16_t, std::size_t> open;  // by thing: its last track
    for (std::size_t i = 0; i < scans.size(); ++i) {
        for (const auto& [thing, box] : boxes_in(scans[i], Pose::Identity())) {
            const auto last = open.find(thing);
            const bool goes_on =
                last != open.end() &&
                tracks[last->second].first + tracks[last->second].boxes.size() == i;
            if (!goes_on) {
                open[thing] = tracks.size();
                tracks.push_back({.first = i, .boxes = {}});
            }
            tracks[open[thing]].boxes.push_back(box);
        }
    }
    return tracks;
}

std::string tracklets_of(const std::vector<TwinTrack>& tracks) {
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\" ?>\n<!DOCTYPE "
        "boost_serialization>\n<boost_serialization signature=\"serialization::archive\" "
        "version=\"9\">\n<tracklets class_id=\"0\" tracking_level=\"0\" version=\"0\">\n\t<count>{}"
        "</count>\n\t<item_version>1</item_version>\n",
        tracks.size());
    for (const TwinTrack& track : tracks) {
        const Eigen::Vector3d size = track.size();
        text += fmt::format(
            "\t<item>\n\t\t<objectType>Pedestrian</objectType>\n\t\t<h>{}</h>\n\t\t<w>{}</"
            "w>\n\t\t<l>{}"
            "</l>\n\t\t<first_frame>{}</first_frame>\n\t\t<poses>\n\t\t\t<count>{}</count>\n\t\t\t"
            "<item_version>2</item_version>\n",
            size.z(), size.y(), size.x(), track.first, track.boxes.size());
        for (const auto& box : track.boxes) {
            text += fmt::format(
                "\t\t\t<item>\n\t\t\t\t<tx>{}</tx>\n\t\t\t\t<ty>{}</ty>\n\t\t\t\t<tz>{}</tz>\n"
                "\t\t\t\t<rx>0</rx>\n\t\t\t\t<ry>0</ry>\n\t\t\t\t<rz>0</rz>\n\t\t\t\t<state>2"
                "</state>\n\t\t\t\t<occlusion>0</occlusion>\n\t\t\t</item>\n",
                box.center().x(), box.center().y(), box.min().z());
        }
        text += "\t\t</poses>\n\t\t<finished>1</finished>\n\t</item>\n";
    }
    return text + "</tracklets>\n</boost_serialization>\n";
}

}  // namespace

void write_nuscenes_twin(const fs::path& root, const std::string& entry) {
    constexpr std::size_t kScans = 50, kEvery = 10;  // 20 Hz, key frames at 2 Hz
    NuscenesTables tables(root / "v1.0-mini");
    for (const char* folder : {"samples", "sweeps"}) {
        fs::create_directories(root / folder / "LIDAR_TOP");
    }
    if (tables["sensor"].empty()) {
        tables["sensor"].push_back(
            {{"token", "lidar"}, {"channel", "LIDAR_TOP"}, {"modality", "lidar"}});
        tables["calibrated_sensor"].push_back({{"token", "mount"},
                                               {"sensor_token", "lidar"},
                                               {"translation", {0.94, 0.0, 1.84}},
                                               {"rotation", {1.0, 0.0, 0.0, 0.0}},
                                               {"camera_intrinsic", ordered_json::array()}});
        tables["attribute"].push_back(
            {{"token", "pedestrian.moving"}, {"name", "pedestrian.moving"}, {"description", ""}});
    }
    tables["scene"].push_back({{"token", entry}, {"name", entry}, {"description", "simulated"}});
    const Pose T_ego_lidar(Eigen::Translation3d(0.94, 0.0, 1.84));
    const auto scans = twin_scans(entry, kScans, "hdl32");
    std::string sample;
    for (std::size_t i = 0; i < kScans; ++i) {
        const std::int64_t stamp = 1532402927647951 + static_cast<std::int64_t>(i) * 50000;  // [us]
        const bool is_key = i % kEvery == 0;
        if (is_key) {
            sample = fmt::format("{}-sample-{}", entry, i);
            tables["sample"].push_back(
                {{"token", sample}, {"timestamp", stamp}, {"scene_token", entry}});
            add_annotations(tables, sample, scans[i], entry);
        }
        const std::string file = fmt::format("{}/LIDAR_TOP/{}__LIDAR_TOP__{}.pcd.bin",
                                             is_key ? "samples" : "sweeps", entry, stamp);
        const std::string token = fmt::format("{}-{}", entry, i);
        const Pose T_world_ego = scans[i].T_world_sensor * T_ego_lidar.inverse();
        tables["ego_pose"].push_back({{"token", token},
                                      {"timestamp", stamp},
                                      {"rotation", rotation_of(T_world_ego)},
                                      {"translation", array_of(T_world_ego.translation())}});
        tables["sample_data"].push_back({{"token", token},
                                         {"sample_token", sample},
                                         {"ego_pose_token", token},
                                         {"calibrated_sensor_token", "mount"},
                                         {"timestamp", stamp},
                                         {"fileformat", "pcd"},
                                         {"is_key_frame", is_key},
                                         {"filename", file}});
        const std::vector<float> ring(scans[i].points.size(), 0.0F);
        const io::Cloud cloud =
            cloud_of(scans[i].points, {"intensity", "ring"}, {scans[i].intensity, ring});
        io::write_file(root / file,
                       {reinterpret_cast<const char*>(cloud.data.data()), cloud.data.size()});
    }
    tables.write();
}

void write_raw_twin(const fs::path& root, const std::string& entry) {
    constexpr std::size_t kScans = 60;
    const fs::path day = root / kDay;
    const fs::path drive = day / fmt::format("{}_drive_{}_sync", kDay, entry);
    for (const char* name : {"velodyne_points/data", "oxts/data"}) {
        fs::create_directories(drive / name);
    }
    const Pose T_velo_imu(Eigen::Translation3d(-0.81, 0.32, -0.80));
    io::write_file(day / "calib_imu_to_velo.txt",
                   "calib_time: 25-May-2012 16:47:16\nR: 1 0 0 0 1 0 0 0 1\nT: -0.81 0.32 -0.80\n");
    const auto scans = twin_scans(entry, kScans);
    const Pose first = scans.front().T_world_sensor * T_velo_imu;
    std::string stamps;
    for (std::size_t i = 0; i < kScans; ++i) {
        const std::string stem = fmt::format("{:010}", i);
        io::write_bin(drive / "velodyne_points" / "data" / (stem + ".bin"), scans[i].points,
                      scans[i].intensity, io::Durable::contents);
        io::write_file(drive / "oxts" / "data" / (stem + ".txt"),
                       oxts_of(scans[i].T_world_sensor * T_velo_imu, first));
        stamps += raw_stamp(i);
    }
    io::write_file(drive / "velodyne_points" / "timestamps.txt", stamps);
    io::write_file(drive / "oxts" / "timestamps.txt", stamps);
    io::write_file(drive / "tracklet_labels.xml", tracklets_of(tracks_of(scans)));
}

void write_doals_twin(const fs::path& root, const std::string& entry) {
    constexpr std::size_t kScans = 60, kEvery = 10;
    constexpr std::int64_t kBegin = 1582196325000000000;  // [ns]
    fs::create_directories(root / entry);
    const auto writer = io::BagWriter::create(root / entry / "bag.bag");
    std::string rows;
    const auto scans = twin_scans(entry, kScans);
    for (std::size_t i = 0; i < kScans; ++i) {
        const std::int64_t stamp = kBegin + static_cast<std::int64_t>(i) * 100'000'000;
        const io::Cloud cloud = cloud_of(scans[i].points, {"intensity"}, {scans[i].intensity});
        writer->write({"/os1_cloud_node/points", "sensor_msgs/PointCloud2", writer->encoding()},
                      stamp,
                      io::cloud_message(cloud, static_cast<double>(stamp) * 1e-9, "os1_lidar",
                                        writer->encoding()));
        if (i % kEvery != kEvery - 1) continue;
        rows += fmt::format("{}", stamp);
        for (std::size_t p = 0; p < scans[i].points.size(); ++p) {
            if (scans[i].labels[p] == Label::dynamic) rows += fmt::format(",{}", p);
        }
        rows += "\n";
    }
    writer->commit();
    io::write_file(root / entry / "indices.csv", rows);
}

}  // namespace dynamic_filter::app
