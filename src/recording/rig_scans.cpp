// SPDX-License-Identifier: MIT
#include "recording/rig_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {
namespace {

/// From the frame of the points of the files into that of the sensor, in the unit of the points.
Eigen::Isometry3d into_sensor_frame(const RigEntry& entry, const Info& info, double unit) {
    Pose T_sensor_points = Pose::Identity();
    if (!entry.field.empty()) {
        T_sensor_points = entry.T_vehicle_sensor->inverse();
    } else if (info.sensor_at) {
        T_sensor_points = Pose(Eigen::Translation3d(-*info.sensor_at));
    }
    T_sensor_points.translation() /= unit;
    return T_sensor_points;
}

/// Which points of a merged cloud are those of the sensor; all of another one.
std::vector<std::size_t> points_of(const RigEntry& entry, const Cloud& cloud,
                                   const std::filesystem::path& file) {
    std::vector<std::size_t> points(cloud.size());
    std::iota(points.begin(), points.end(), std::size_t{0});
    if (entry.field.empty()) return points;
    const Field* const field = cloud.find(entry.field);
    if (field == nullptr) {
        throw InputError(file, "",
                         fmt::format("has no field '{}', which tells the points of sensor '{}'",
                                     entry.field, entry.name));
    }
    const std::vector<double> of = values(cloud, *field);
    std::erase_if(points, [&](std::size_t i) { return of[i] != entry.value; });
    return points;
}

/// The first cloud of the sensor that can be read; empty if none of the first few can.
Cloud some_cloud(const Recording& recording, double& stamp) {
    constexpr std::size_t kTries = 10;
    for (std::size_t i = 0; i < std::min(kTries, recording.size()); ++i) {
        try {
            Cloud cloud = recording.parts().read_cloud(i);
            stamp = recording.info().stamps[i];
            if (cloud.size() > 0) return cloud;
        } catch (const InputError&) {
            continue;  // it is rejected later, with the reason
        }
    }
    return {};
}

}  // namespace

CommonFields fields_of(const Rig& rig, std::vector<std::string>& notes) {
    std::vector<Cloud> clouds;
    bool timed = false;
    for (std::size_t s = 0; s < rig.recordings.size(); ++s) {
        double stamp = 0.0;
        Cloud cloud = some_cloud(rig.recordings[s], stamp);
        if (cloud.size() == 0) {
            throw InputError(rig.file.sensors[s].recording, "",
                             fmt::format("sensor '{}': none of its first scans can be read",
                                         rig.file.sensors[s].name));
        }
        timed |= !point_times(cloud, stamp).empty();
        clouds.push_back(std::move(cloud));
    }
    CommonFields fields = common_fields(clouds, timed);
    if (!fields.left_out.empty()) {
        notes.push_back("not all sensors have these fields, so they are left out: " +
                        fields.left_out);
    }
    return fields;
}

Cloud read_cloud_of(const Rig& rig, OneOf one, double unit) {
    const RigEntry& entry = rig.file.sensors[one.sensor];
    const Recording& recording = rig.recordings[one.sensor];
    const Info& info = recording.info();
    const Cloud cloud = recording.parts().read_cloud(one.scan);
    return in_common_fields(cloud, points_of(entry, cloud, info.scan_files[one.scan]), rig.fields,
                            into_sensor_frame(entry, info, unit), info.stamps[one.scan],
                            one.sensor);
}

Labels read_truth_of(const Rig& rig, OneOf one, const Cloud& cloud) {
    const Recording& recording = rig.recordings[one.sensor];
    const RigEntry& entry = rig.file.sensors[one.sensor];
    const Info& info = recording.info();
    const auto truth_of = [&, &read = recording.parts().read_truth](const Cloud& of) {
        return read ? read(one.scan, of) : read_labels(info.label_files[one.scan]);
    };
    if (entry.field.empty()) return truth_of(cloud);
    const Cloud merged = recording.parts().read_cloud(one.scan);
    const Labels all = truth_of(merged);
    if (all.size() != merged.size()) {
        throw InputError(info.label_files[one.scan], "",
                         fmt::format("{} labels but {} points", all.size(), merged.size()));
    }
    Labels labels;
    for (const std::size_t i : points_of(entry, merged, info.scan_files[one.scan])) {
        labels.push_back(all[i]);
    }
    return labels;
}

}  // namespace dynamic_filter::io
