// SPDX-License-Identifier: MIT
#include "export/outputs.hpp"

#include <fmt/format.h>

#include "base/output_folder.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/label_files.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// SemanticKITTI's layout; poses are the LiDAR's.
class KittiSink final : public Sink {
public:
    KittiSink(const fs::path& folder, bool overwrite)
        : output_(folder, recording_files(), replaced_if(overwrite)),
          scans_(output_.subfolder("velodyne")) {}

    void append(const io::FullScan& scan, const Labels& labels, const std::string&) override {
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

}  // namespace

const FolderFiles& recording_files() {
    static const FolderFiles files{
        .files = {"poses.txt", "times.txt"},
        .folders = {{"labels", ".label"}, {"velodyne", ".bin"}, {"knowable", ".bin"}}};
    return files;
}

std::unique_ptr<Sink> make_kitti_sink(const ConvertOptions& o) {
    return std::make_unique<KittiSink>(o.output, o.overwrite);
}

}  // namespace dynamic_filter::app
