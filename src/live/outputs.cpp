// SPDX-License-Identifier: MIT
#include "live/outputs.hpp"

#include <cstring>
#include <limits>

#include "dynamic_filter/cloud.hpp"
#include "geometry/kept.hpp"

namespace dynamic_filter::live {

namespace {

/// Writes a stamp into the header with which a message begins. Both encodings have it after four
/// bytes; io::cloud_message() takes a double, which cannot hold all nanoseconds.
void restamp(std::vector<std::byte>& message, std::int64_t stamp_ns) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    constexpr std::size_t kAt = 4;
    const std::array<std::uint32_t, 2> time{static_cast<std::uint32_t>(stamp_ns / kSecond),
                                            static_cast<std::uint32_t>(stamp_ns % kSecond)};
    std::memcpy(message.data() + kAt, time.data(), sizeof time);
}

/// The records of a cloud that `takes` selects, by their index.
template <class Takes>
io::Cloud selected(const io::Cloud& cloud, const Takes& takes) {
    io::Cloud part;
    part.fields = cloud.fields;
    part.point_bytes = cloud.point_bytes;
    part.data.resize(cloud.data.size());
    std::byte* to = part.data.data();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (!takes(i)) continue;
        std::memcpy(to, cloud.data.data() + i * cloud.point_bytes, cloud.point_bytes);
        to += cloud.point_bytes;
    }
    part.data.resize(static_cast<std::size_t>(to - part.data.data()));
    return part;
}

/// Makes a cloud of rows of values of one type each.
class Table {
public:
    explicit Table(std::size_t rows) : rows_(rows) {}
    void column(const char* name, io::FieldType type) { io::add_field(cloud_, name, type); }
    void begin() {
        cloud_.data.resize(rows_ * cloud_.point_bytes);
        to_ = cloud_.data.data();
    }
    template <class T>
    void put(T value) {
        std::memcpy(to_, &value, sizeof value);
        to_ += sizeof value;
    }
    void put(const Point& point) {
        for (const float value : point) put(value);
    }
    [[nodiscard]] const io::Cloud& cloud() const { return cloud_; }

private:
    std::size_t rows_;
    io::Cloud cloud_;
    std::byte* to_ = nullptr;
};

void add_position(Table& table) {
    for (const char* axis : {"x", "y", "z"}) table.column(axis, io::FieldType::f32);
}

io::Cloud label_cloud(const Points& points, const Verdict& verdict) {
    Table table(points.size());
    add_position(table);
    table.column("label", io::FieldType::u8);
    table.column("probability", io::FieldType::f32);
    table.begin();
    for (std::size_t i = 0; i < points.size(); ++i) {
        table.put(points[i]);
        table.put(static_cast<std::uint8_t>(verdict.labels[i]));
        // Preset paper has none before a scan is settled.
        table.put(verdict.probability.empty() ? std::numeric_limits<float>::quiet_NaN()
                                              : verdict.probability[i]);
    }
    return table.cloud();
}

io::Cloud correction_cloud(const JudgedScan& scan, const Verdict& verdict) {
    std::vector<std::uint32_t> changed;
    for (std::uint32_t i = 0; i < scan.labels.size(); ++i) {
        if (scan.labels[i] != verdict.labels[i]) changed.push_back(i);
    }
    Table table(changed.size());
    add_position(table);
    table.column("index", io::FieldType::u32);
    table.column("label", io::FieldType::u8);
    table.column("probability", io::FieldType::f32);
    table.begin();
    for (const std::uint32_t i : changed) {
        table.put(scan.points[i]);
        table.put(i);
        table.put(static_cast<std::uint8_t>(verdict.labels[i]));
        table.put(verdict.probability[i]);
    }
    return table.cloud();
}

io::Cloud map_cloud(const std::vector<StaticVoxel>& voxels) {
    Table table(voxels.size());
    add_position(table);
    table.column("probability", io::FieldType::f32);
    table.begin();
    for (const StaticVoxel& voxel : voxels) {
        table.put(Point(voxel.center.cast<float>()));
        table.put(voxel.probability);
    }
    return table.cloud();
}

}  // namespace

OutputTopics::OutputTopics(const LiveConfig& config, io::MessageEncoding encoding) {
    const std::string& prefix = config.output.prefix;
    const Quality scans{.reliable = config.output.qos == "reliable", .latched = false, .depth = 2};
    const Quality latched{.reliable = true, .latched = true, .depth = 1};
    const Quality usual{.reliable = true, .latched = false, .depth = 10};
    const auto cloud = [&](const char* name, const Quality& quality) {
        return Output{{prefix + name, "sensor_msgs/PointCloud2", encoding}, quality};
    };
    still = cloud("/static", scans);
    dynamic = cloud("/dynamic", scans);
    labels = cloud("/labels", scans);
    corrections = cloud("/corrections", scans);
    map = cloud("/map", latched);
    grid = {{prefix + "/occupancy", "nav_msgs/OccupancyGrid", encoding}, latched};
    removed = {{prefix + "/removed", "visualization_msgs/MarkerArray", encoding}, usual};
    path = {{prefix + "/path", "nav_msgs/Path", encoding}, usual};
    diagnostics = {{"/diagnostics", "diagnostic_msgs/DiagnosticArray", encoding}, usual};
    transform = {{"/tf", "tf2_msgs/TFMessage", encoding}, usual};
    transform.quality.depth = 100;
}

std::vector<Output> OutputTopics::all() const {
    return {still, dynamic, labels, corrections, map, grid, removed, path, diagnostics, transform};
}

Outputs::Outputs(const LiveConfig& config, io::MessageEncoding encoding, Publisher& bus,
                 Publisher* display)
    : config_(config),
      encoding_(encoding),
      topics_(config, encoding),
      bus_(bus),
      display_(display) {
    for (const Output& output : topics_.all()) {
        bus_.advertise(output.topic, output.quality);
        if (display_ != nullptr) display_->advertise(output.topic, output.quality);
    }
}

bool Outputs::is_wanted(const Output& output) const {
    return bus_.is_wanted(output.topic.name) ||
           (display_ != nullptr && display_->is_wanted(output.topic.name));
}

/// A latched message is given to all, for those who come later.
void Outputs::publish(const Output& output, double stamp, std::vector<std::byte> message) {
    const Bytes bytes = std::make_shared<const std::vector<std::byte>>(std::move(message));
    for (Publisher* publisher : {&bus_, display_}) {
        if (publisher == nullptr) continue;
        if (!output.quality.latched && !publisher->is_wanted(output.topic.name)) continue;
        if (!publisher->publish(output.topic.name, stamp, bytes)) ++not_taken_;
    }
}

void Outputs::publish_part(const Output& output, const LiveScan& scan, const Labels& labels,
                           bool dynamic) {
    if (!is_wanted(output)) return;
    const bool keeps_unknown = config_.filter.map.keep_unknown;
    const auto takes = [&](std::size_t i) {
        return where(labels[i], false, keeps_unknown) == (dynamic ? Kept::removed : Kept::in_map);
    };
    auto message =
        io::cloud_message(selected(scan.cloud, takes), scan.stamp, scan.frame, encoding_);
    restamp(message, scan.stamp_ns);
    publish(output, scan.stamp, std::move(message));
}

JudgedScan Outputs::judged(const LiveScan& scan, const Verdict& verdict) {
    const Points points = io::positions(scan.cloud);
    if (is_wanted(topics_.labels)) {
        auto message =
            io::cloud_message(label_cloud(points, verdict), scan.stamp, scan.frame, encoding_);
        restamp(message, scan.stamp_ns);
        publish(topics_.labels, scan.stamp, std::move(message));
    }
    publish_part(topics_.still, scan, verdict.labels, false);
    publish_part(topics_.dynamic, scan, verdict.labels, true);
    const Pose T_world_sensor =
        verdict.tracked ? verdict.tracked->T_world_sensor : scan.T_world_sensor;
    const std::string& world = scan.has_pose ? scan.world : config_.output.map_frame;
    if (!scan.has_pose) publish_transform(scan, T_world_sensor);
    display_pose(scan, T_world_sensor, world);
    const bool in_world = scan.has_pose && scan.frame == scan.world;
    publish_removed(scan.stamp, points, verdict.labels,
                    in_world ? Pose::Identity() : T_world_sensor, world);
    if (scan.sensor == 0) publish_path(scan.stamp, T_world_sensor, world);
    return {scan.frame, scan.stamp_ns, points, verdict.labels};
}

void Outputs::settled(const JudgedScan& scan, const Verdict& verdict) {
    const double stamp = 1e-9 * static_cast<double>(scan.stamp_ns);
    auto message = io::cloud_message(correction_cloud(scan, verdict), stamp, scan.frame, encoding_);
    restamp(message, scan.stamp_ns);
    publish(topics_.corrections, stamp, std::move(message));
}

void Outputs::map(const std::vector<StaticVoxel>& voxels, const std::string& world, double stamp) {
    publish(topics_.map, stamp, io::cloud_message(map_cloud(voxels), stamp, world, encoding_));
}

void Outputs::grid(const io::OccupancyCells& cells, const std::string& world, double stamp) {
    publish(topics_.grid, stamp, io::occupancy_message(cells, stamp, world, encoding_));
}

void Outputs::diagnostics(const std::vector<io::DiagnosticStatus>& statuses, double stamp) {
    if (!is_wanted(topics_.diagnostics)) return;
    publish(topics_.diagnostics, stamp, io::diagnostics_message(statuses, stamp, encoding_));
}

void Outputs::publish_removed(double stamp, const Points& points, const Labels& labels,
                              const Pose& T_world_points, const std::string& world) {
    if (!is_wanted(topics_.removed)) return;
    const auto boxes = boxes_around(points, labels, T_world_points);
    publish(topics_.removed, stamp, io::boxes_message(boxes, stamp, world, encoding_));
}

/// A pose at every half metre, of the last 2.5 km or so; at most once a second.
void Outputs::publish_path(double stamp, const Pose& T_world_sensor, const std::string& world) {
    constexpr double kStep = 0.5, kPause = 1.0;  // [m], [s]
    constexpr std::size_t kMost = 5000;
    if (world != path_world_ || (!path_stamps_.empty() && stamp < path_stamps_.back())) {
        path_.clear();
        path_stamps_.clear();
        path_world_ = world;
    }
    const bool moved =
        path_.empty() || (T_world_sensor.translation() - path_.back().translation()).norm() > kStep;
    if (moved) {
        path_.push_back(T_world_sensor);
        path_stamps_.push_back(stamp);
    }
    if (path_.size() > kMost) {
        path_.pop_front();
        path_stamps_.pop_front();
    }
    if (std::abs(stamp - path_told_) < kPause || !is_wanted(topics_.path)) return;
    path_told_ = stamp;
    publish(topics_.path, stamp,
            io::path_message(world, {path_stamps_.begin(), path_stamps_.end()},
                             {path_.begin(), path_.end()}, encoding_));
}

/// The transform of the frame that is the root so far, so that each frame keeps its one parent.
void Outputs::publish_transform(const LiveScan& scan, const Pose& T_map_sensor) {
    const std::string& map = config_.output.map_frame;
    if (!config_.output.transform || !scan.T_root_sensor || scan.root == map) return;
    if (!bus_.is_wanted(topics_.transform.topic.name)) return;
    const Pose T_map_root = T_map_sensor * scan.T_root_sensor->inverse();
    auto message = io::transform_message(map, scan.root, T_map_root, scan.stamp, encoding_);
    const bool taken = bus_.publish(topics_.transform.topic.name, scan.stamp,
                                    std::make_shared<const std::vector<std::byte>>(message));
    not_taken_ += taken ? 0U : 1U;
}

void Outputs::display_pose(const LiveScan& scan, const Pose& T_world_sensor,
                           const std::string& world) {
    const std::string& topic = topics_.transform.topic.name;
    if (display_ == nullptr || !display_->is_wanted(topic) || scan.frame == world) return;
    auto message = io::transform_message(world, scan.frame, T_world_sensor, scan.stamp, encoding_);
    display_->publish(topic, scan.stamp,
                      std::make_shared<const std::vector<std::byte>>(std::move(message)));
}

std::vector<io::BoxMarker> boxes_around(const Points& points, const Labels& labels,
                                        const Pose& T_world_sensor) {
    constexpr double kCell = 0.5;  // [m]
    constexpr std::size_t kLeast = 5, kMost = 200;
    using Cell = std::array<int, 3>;
    std::map<Cell, std::vector<Eigen::Vector3d>> cells;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (labels[i] != Label::dynamic || !points[i].allFinite()) continue;
        const Eigen::Vector3d p = T_world_sensor * points[i].cast<double>();
        const Eigen::Vector3d at = (p / kCell).array().floor();
        cells[{static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())}]
            .push_back(p);
    }
    std::vector<std::pair<std::size_t, io::BoxMarker>> boxes;
    while (!cells.empty()) {
        std::vector<Cell> open{cells.begin()->first};
        Eigen::AlignedBox3d box;
        std::size_t count = 0;
        while (!open.empty()) {
            const Cell cell = open.back();
            open.pop_back();
            const auto found = cells.find(cell);
            if (found == cells.end()) continue;
            for (const Eigen::Vector3d& p : found->second) box.extend(p);
            count += found->second.size();
            cells.erase(found);
            for (int k = 0; k < 27; ++k) {
                open.push_back({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
            }
        }
        if (count < kLeast) continue;
        boxes.push_back({count, {box.center(), box.sizes().cwiseMax(0.05)}});
    }
    std::stable_sort(boxes.begin(), boxes.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    if (boxes.size() > kMost) boxes.resize(kMost);
    std::vector<io::BoxMarker> result;
    for (auto& [count, box] : boxes) result.push_back(box);
    return result;
}

}  // namespace dynamic_filter::live
