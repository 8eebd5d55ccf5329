// SPDX-License-Identifier: MIT
#include "recording/rig_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "geometry/pose.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

/// A table of the file, and what reads its values. Every error names the file and the line.
class Table {
public:
    Table(const toml::table& table, const fs::path& file) : table_(&table), file_(&file) {}

    [[noreturn]] void fail(const toml::node& where, const std::string& why) const {
        throw InputError(*file_, fmt::format("line {}", where.source().begin.line), why);
    }
    [[noreturn]] void fail(const std::string& why) const { fail(*table_, why); }

    [[nodiscard]] const toml::node* find(const char* key) const { return table_->get(key); }

    void refuse_others(const std::vector<std::string>& known) const {
        for (const auto& [key, node] : *table_) {
            const std::string name(key.str());
            if (std::find(known.begin(), known.end(), name) == known.end()) {
                fail(node,
                     fmt::format("'{}' is not known; known are {}", name, fmt::join(known, ", ")));
            }
        }
    }

    [[nodiscard]] std::string text(const char* key) const {
        const toml::node* const node = find(key);
        if (node == nullptr) return "";
        if (node->as_string() == nullptr || node->as_string()->get().empty()) {
            fail(*node, fmt::format("{} must be a text in quotation marks", key));
        }
        return node->as_string()->get();
    }

    [[nodiscard]] double number(const char* key) const {
        const toml::node* const node = find(key);
        if (node == nullptr) return 0.0;
        const auto value = node->value<double>();
        if (!value || !std::isfinite(*value)) fail(*node, fmt::format("{} must be a number", key));
        return *value;
    }

    template <int N>
    [[nodiscard]] Eigen::Matrix<double, N, 1> numbers(const toml::node& node,
                                                      const char* what) const {
        const toml::array* const array = node.as_array();
        Eigen::Matrix<double, N, 1> out;
        bool is_good = array != nullptr && array->size() == N;
        for (int k = 0; is_good && k < N; ++k) {
            const auto value = (*array)[static_cast<std::size_t>(k)].value<double>();
            is_good = value && std::isfinite(*value);
            if (is_good) out[k] = *value;
        }
        if (!is_good) fail(node, fmt::format("expected {}", what));
        return out;
    }

private:
    const toml::table* table_;
    const fs::path* file_;
};

/// Where the sensor is, by `at` and one of `turn` and `quaternion`.
std::optional<Pose> place_in(const Table& table) {
    const toml::node *at = table.find("at"), *turn = table.find("turn"),
                     *quaternion = table.find("quaternion");
    if (at == nullptr && turn == nullptr && quaternion == nullptr) return std::nullopt;
    if (at == nullptr) {
        table.fail("has a rotation but no place; expected at = [x, y, z] in metres");
    }
    if (turn != nullptr && quaternion != nullptr) {
        table.fail(*turn, "turn and quaternion are both given; keep one of them");
    }
    Pose pose = Pose::Identity();
    pose.translation() = table.numbers<3>(*at, "at = [x, y, z] in metres");
    constexpr double kFarOnAVehicle = 100.0;  // [m]
    if (pose.translation().norm() > kFarOnAVehicle) {
        table.fail(*at, "is more than 100 m from the vehicle; expected metres");
    }
    if (turn != nullptr) {
        pose.linear() = turned_by(table.numbers<3>(*turn, "turn = [roll, pitch, yaw] in degrees"));
    }
    if (quaternion != nullptr) {
        const auto q = table.numbers<4>(*quaternion, "quaternion = [x, y, z, w]");
        if (std::abs(q.norm() - 1.0) > 0.01) {
            table.fail(*quaternion,
                       fmt::format("has the length {:.3f}; that of a rotation is 1", q.norm()));
        }
        pose.linear() = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
    }
    return pose;
}

RigEntry entry_of(const Table& table, const fs::path& folder) {
    table.refuse_others(
        {"name", "recording", "topic", "at", "turn", "quaternion", "clock", "field", "value"});
    RigEntry entry;
    const std::string recording = table.text("recording");
    if (recording.empty()) table.fail("has no recording = \"FOLDER OR BAG\"");
    entry.recording = (folder / recording).lexically_normal();
    if (!fs::exists(entry.recording)) {
        table.fail(*table.find("recording"), entry.recording.string() + " does not exist");
    }
    if (is_rig_file(entry.recording)) {
        table.fail(*table.find("recording"),
                   entry.recording.string() + " is a rig file itself; list its sensors here");
    }
    entry.name = table.text("name");
    if (entry.name.empty()) table.fail("has no name = \"...\", such as \"front\"");
    const bool is_plain = std::all_of(entry.name.begin(), entry.name.end(), [](char c) {
        return is_letter_or_digit(c) || c == '-' || c == '_';
    });
    if (!is_plain) {
        table.fail(*table.find("name"), "the name '" + entry.name +
                                            "' is part of the names of files; expected letters, "
                                            "digits, - and _ alone");
    }
    entry.topic = table.text("topic");
    entry.T_vehicle_sensor = place_in(table);
    entry.clock = table.number("clock");
    entry.field = table.text("field");
    entry.value = table.number("value");
    if (entry.field.empty() != (table.find("value") == nullptr)) {
        table.fail(
            "field and value belong together: the points whose field has this value are "
            "those of the sensor");
    }
    if (!entry.field.empty() && !entry.T_vehicle_sensor) {
        table.fail(
            "its points are taken out of merged clouds, so its place is needed: at = [x, y, "
            "z] in metres, in the frame of these clouds");
    }
    return entry;
}

void refuse_twice(const RigFile& rig, const fs::path& file) {
    std::set<std::string> names;
    std::set<std::string> sources;
    for (const RigEntry& entry : rig.sensors) {
        if (!names.insert(entry.name).second) {
            throw InputError(file, "", "has two sensors of the name '" + entry.name + "'");
        }
        const std::string source =
            fmt::format("{}|{}|{}|{}", fs::weakly_canonical(entry.recording).string(), entry.topic,
                        entry.field, entry.value);
        if (!sources.insert(source).second) {
            throw InputError(file, "",
                             fmt::format("the scans of '{}' are those of another sensor: give each "
                                         "its own recording, topic, or value of a field",
                                         entry.name));
        }
    }
}

}  // namespace

bool is_rig_file(const fs::path& path) {
    return to_lower(path.extension().string()) == ".toml" && fs::is_regular_file(path);
}

RigFile read_rig_file(const fs::path& file) {
    const std::string text = read_file(file);
    constexpr std::size_t kMost = 1U << 16U;  // [bytes] also bounds how deep tables can be nested
    if (text.size() > kMost) throw InputError(file, "", "is too large for the file of a rig");
    toml::table parsed;
    try {
        parsed = toml::parse(text);
    } catch (const toml::parse_error& error) {
        throw InputError(file, fmt::format("line {}", error.source().begin.line),
                         fmt::format("not TOML: {}", error.description()));
    }
    const Table top(parsed, file);
    const toml::node* const list = top.find("sensor");
    if (list == nullptr || list->as_array() == nullptr) {
        throw InputError(
            file, "",
            "lists no sensors; expected a table [[sensor]] with name, recording and at "
            "for each of them (a file of settings goes after --config)");
    }
    top.refuse_others({"poses", "sensor"});
    RigFile rig;
    const fs::path folder = file.parent_path();
    for (const toml::node& node : *list->as_array()) {
        if (node.as_table() == nullptr) top.fail(node, "expected a table [[sensor]]");
        rig.sensors.push_back(entry_of(Table(*node.as_table(), file), folder));
    }
    if (rig.sensors.size() < 2) {
        throw InputError(file, "", "has one sensor; give its recording itself");
    }
    constexpr std::size_t kMostSensors = 100;  // their numbers are bytes
    if (rig.sensors.size() > kMostSensors) throw InputError(file, "", "has more than 100 sensors");
    refuse_twice(rig, file);
    if (const std::string poses = top.text("poses"); !poses.empty()) {
        rig.poses = (folder / poses).lexically_normal();
    }
    return rig;
}

}  // namespace dynamic_filter::io
