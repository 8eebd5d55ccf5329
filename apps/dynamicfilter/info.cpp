// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "commands.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/bag.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/io/sequence.hpp"

namespace dynamic_filter::app {

namespace {

constexpr const char* kTypeNames[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                      "uint32", "int64", "uint64", "float32", "float64"};

void describe_cloud(const std::filesystem::path& file) {
    const io::Cloud cloud = io::read_cloud(file);
    fmt::print("{}\n  points  {}\n", file.string(), cloud.size());
    for (const io::Field& field : cloud.fields) {
        double low = INFINITY, high = -INFINITY;
        std::size_t finite = 0;
        for (const double value : io::values(cloud, field)) {
            if (!std::isfinite(value)) continue;
            ++finite;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        fmt::print("  {:<10} {:<8}", field.name, kTypeNames[static_cast<std::size_t>(field.type)]);
        if (field.count > 1) fmt::print(" x{}", field.count);
        if (finite > 0) fmt::print(" {:.4g} .. {:.4g}", low, high);
        if (finite < cloud.size()) fmt::print(" ({} not finite)", cloud.size() - finite);
        fmt::print("\n");
    }
    if (cloud.viewpoint) {
        const Eigen::Vector3d t = cloud.viewpoint->translation();
        fmt::print("  viewpoint {:.3f} {:.3f} {:.3f}\n", t.x(), t.y(), t.z());
    }
}

void describe_sequence(const std::filesystem::path& folder) {
    const io::Sequence s = io::open_sequence(folder);
    fmt::print("{}\n  format  {}\n  scans   {}\n", folder.string(), io::to_string(s.format),
               s.size());
    if (s.size() > 1) {
        fmt::print("  stamps  {:.3f} .. {:.3f} s{}\n", s.stamps.front(), s.stamps.back(),
                   s.measured_stamps ? "" : " (made up at 10 Hz)");
    }
    if (!s.T_world_sensor.empty()) {
        double length = 0.0;
        for (std::size_t i = 1; i < s.size(); ++i) {
            length +=
                (s.T_world_sensor[i].translation() - s.T_world_sensor[i - 1].translation()).norm();
        }
        fmt::print("  path    {:.1f} m\n", length);
    }
    fmt::print("  truth   {}\n", s.has_truth() ? "yes" : "none");
    for (const std::string& note : s.notes) fmt::print("  note    {}\n", note);
    describe_cloud(s.scan_files.front());
}

void describe_bag(const std::filesystem::path& path) {
    struct Count {
        io::Topic topic;
        std::size_t messages = 0;
    };
    std::map<std::string, Count> topics;
    std::int64_t first = INT64_MAX, last = INT64_MIN;
    const io::Bag bag(path);
    const auto defects = bag.for_each([&](const io::Message& message) {
        Count& count = topics[message.topic.name];
        count.topic = message.topic;
        ++count.messages;
        first = std::min(first, message.recorded_ns);
        last = std::max(last, message.recorded_ns);
    });
    fmt::print("{}\n  format  bag\n", path.string());
    if (!topics.empty()) {
        fmt::print("  length  {:.1f} s\n", 1e-9 * static_cast<double>(last - first));
    }
    for (const auto& [name, count] : topics) {
        fmt::print("  {:<28} {:<40} {:>7} messages\n", name, count.topic.type, count.messages);
    }
    for (const io::Defect& defect : defects) {
        fmt::print("  {}    {}\n", defect.lost ? "LOST" : "note", defect.what);
    }
}

}  // namespace

int info(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) throw InputError(file, "", "does not exist");
    if (io::Bag::recognises(file)) {
        describe_bag(file);
    } else {
        std::filesystem::is_directory(file) ? describe_sequence(file) : describe_cloud(file);
    }
    return kDone;
}

}  // namespace dynamic_filter::app
