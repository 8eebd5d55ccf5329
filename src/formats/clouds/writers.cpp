// SPDX-License-Identifier: MIT
#include "dynamic_filter/writers.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>

#include "dynamic_filter/error.hpp"
#include "formats/clouds/pcd_header.hpp"

namespace dynamic_filter::io {

PcdWriter::PcdWriter(const std::filesystem::path& path, const std::vector<Field>& fields,
                     std::size_t point_bytes)
    : file_(path), point_bytes_(point_bytes) {
    const PcdHeaderText header = pcd_header_text(fields, 0, Pose::Identity());
    width_at_ = header.width_at;
    points_at_ = header.points_at;
    file_.write(header.text);
}

void PcdWriter::append(std::span<const std::byte> records) {
    if (point_bytes_ == 0 || records.size() % point_bytes_ != 0) {
        throw Error("PcdWriter::append needs whole records of " + std::to_string(point_bytes_) +
                    " bytes, got " + std::to_string(records.size()) + " bytes");
    }
    file_.write(records);
    points_ += records.size() / point_bytes_;
}

void PcdWriter::commit() {
    file_.rewrite(width_at_, pcd_count(points_));
    file_.rewrite(points_at_, pcd_count(points_));
    file_.commit();
}

void write_bin(const std::filesystem::path& path, const Points& points,
               std::span<const float> intensity, Durable durable) {
    if (points.size() != intensity.size()) {
        throw OutputError(
            path, fmt::format("{} points but {} intensities", points.size(), intensity.size()));
    }
    AtomicFile file(path);
    std::vector<std::array<float, 4>> records(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        records[i] = {points[i].x(), points[i].y(), points[i].z(), intensity[i]};
    }
    file.write(std::as_bytes(std::span(records)));
    file.commit(durable);
}

void write_labels(const std::filesystem::path& path, const Labels& labels, Durable durable) {
    std::vector<std::uint32_t> wide(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) wide[i] = static_cast<std::uint32_t>(labels[i]);
    write_numbered_labels(path, wide, durable);
}

void write_numbered_labels(const std::filesystem::path& path, std::span<const std::uint32_t> labels,
                           Durable durable) {
    AtomicFile file(path);
    file.write(std::as_bytes(labels));
    file.commit(durable);
}

void write_times(const std::filesystem::path& path, std::span<const double> stamps) {
    std::string text;
    for (const double stamp : stamps) fmt::format_to(std::back_inserter(text), "{}\n", stamp);
    write_file(path, text);
}

}  // namespace dynamic_filter::io
