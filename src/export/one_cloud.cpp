// SPDX-License-Identifier: MIT
#include "export/outputs.hpp"

#include <fmt/format.h>

#include "base/output_folder.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "recording/world_records.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// All points in the world's frame, in one file; a field `dynamic` says what moves.
class CloudSink final : public Sink {
public:
    explicit CloudSink(fs::path file) : file_(std::move(file)) {}

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

void check_cloud_output(const ConvertOptions& o) {
    if (!io::can_write_cloud(o.output)) {  // before hours of reading, not after
        throw ConfigError(
            fmt::format("{}: unknown extension; expected {}, .mcap, .bag, .db3, or "
                        "none for a folder",
                        o.output.string(), io::cloud_kinds_written()));
    }
    refuse_existing(o.output, o.overwrite);
}

std::unique_ptr<Sink> make_cloud_sink(const ConvertOptions& o) {
    check_cloud_output(o);
    return std::make_unique<CloudSink>(o.output);
}

}  // namespace dynamic_filter::app
