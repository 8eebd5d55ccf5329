// SPDX-License-Identifier: MIT
#include "export/outputs.hpp"

#include <fmt/format.h>
#include <array>
#include <cstring>

#include "base/output_folder.hpp"
#include "dynamic_filter/writers.hpp"
#include "recording/scans.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// DynamicMap_Benchmark's layout: points in the world, pose in VIEWPOINT, truth in the intensity.
class BenchmarkSink final : public Sink {
public:
    BenchmarkSink(const fs::path& folder, bool overwrite)
        : output_(folder, benchmark_files(), replaced_if(overwrite)),
          scans_(output_.subfolder("pcd")) {
        for (const char* name : {"x", "y", "z", "intensity"}) {
            io::add_field(layout_, name, io::FieldType::f32);
        }
    }

    void append(const io::FullScan& scan, const Labels& labels, const std::string&) override {
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

}  // namespace

const FolderFiles& benchmark_files() {
    static const FolderFiles files{.files = {"gt_cloud.pcd"}, .folders = {{"pcd", ".pcd"}}};
    return files;
}

std::unique_ptr<Sink> make_benchmark_sink(const ConvertOptions& o) {
    return std::make_unique<BenchmarkSink>(o.output, o.overwrite);
}

}  // namespace dynamic_filter::app
