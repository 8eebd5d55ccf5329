// SPDX-License-Identifier: MIT
#include "recording/bag_poses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/poses_at_scans.hpp"
#include "recording/scan_overlay.hpp"

namespace dynamic_filter::io {
namespace {

using Topics = std::map<std::string, PoseTopic>;

struct Question {
    const BagContents& contents;
    const std::string& sensor;
    const std::vector<double>& stamps;
    const std::function<Cloud(std::size_t)>& read;
    LinkLookup lookup;
};

/// A reading of the poses. It owns what its source refers to, if the contents of the bag do not.
struct Candidate {
    std::shared_ptr<const FrameTree> tree;
    std::shared_ptr<const PoseTopic> topic;
    PoseSource source;
    std::string name;  // what tells it from the others, for the user
};

struct Judged {
    std::size_t best = 0;
    std::string note;  // what was compared; empty for a single candidate
};

/// The first candidate, unless scans overlay better with another one.
Judged judge(const std::vector<Candidate>& candidates, const Question& question) {
    Judged judged;
    if (candidates.size() < 2) return judged;
    const ScanOverlay overlay(question.stamps.size(), question.read);
    std::vector<double> shares;
    std::string told;
    for (const Candidate& candidate : candidates) {
        const auto pose = [&](std::size_t i) {
            return candidate.source.T_world_sensor(question.stamps[i]).value_or(lost_pose());
        };
        shares.push_back(overlay.share(pose, candidate.source.points_in_world));
        told += fmt::format("{} by {:.0f} % with {}", told.empty() ? "" : ",",
                            100.0 * shares.back(), candidate.name);
        if (overlays_better(shares.back(), shares[judged.best])) judged.best = shares.size() - 1;
    }
    judged.note =
        fmt::format("the poses of the bag can be read in several ways; scans overlay{}: {} is used",
                    told, candidates[judged.best].name);
    return judged;
}

BagPoses poses_of(Candidate candidate, std::vector<std::string> notes) {
    BagPoses poses;
    poses.trajectory = trajectory_of(candidate.source);
    poses.points_in_world = candidate.source.points_in_world;
    poses.is_linked = candidate.source.is_linked;
    notes.insert(notes.begin(), candidate.source.note);
    poses.notes = std::move(notes);
    poses.T_world_sensor = [kept = std::move(candidate)](double stamp) {
        return kept.source.T_world_sensor(stamp);
    };
    return poses;
}

BagPoses best_of(std::vector<Candidate> candidates, const Question& question) {
    const Judged judged = judge(candidates, question);
    std::vector<std::string> notes;
    if (!judged.note.empty()) notes.push_back(judged.note);
    return poses_of(std::move(candidates[judged.best]), std::move(notes));
}

// Poses from /tf.

/// By reading of the tree, those in which `frame` moves.
std::vector<Candidate> by_frames(const Question& question, const std::string& frame,
                                 const std::string& world = {}) {
    std::vector<Candidate> candidates;
    for (FrameReading& reading : question.contents.frames.readings(frame)) {
        const auto tree = std::make_shared<const FrameTree>(std::move(reading.tree));
        if (!tree->moves(frame)) continue;
        std::string name = reading.link.empty() ? fmt::format("'{}' in /tf", frame) : reading.link;
        if (!reading.author.empty()) name += " " + reading.author;
        candidates.push_back(
            {tree, {}, from_frames(*tree, frame, world, question.lookup), std::move(name)});
    }
    return candidates;
}

/// True for the usual names of frames that do not move.
bool names_world(const std::string& frame) {
    constexpr std::array<std::string_view, 6> kNames = {"map",   "odom",        "world",
                                                        "earth", "camera_init", "global"};
    return std::find(kNames.begin(), kNames.end(), frame) != kNames.end();
}

/// Of a sensor that stands still in the world, as /tf says.
std::vector<Candidate> standing_still(const Question& question) {
    const FrameTree& tree = question.contents.frames;
    const auto chain = tree.above(question.sensor);
    if (chain.size() < 2 || !names_world(chain.back())) return {};
    Candidate candidate{{}, {}, from_frames(tree, question.sensor, {}, question.lookup), ""};
    candidate.source.note += ", where it never moves";
    return {std::move(candidate)};
}

/// The frame from which clouds in a frame of the world are seen: the only LiDAR that moves in it,
/// or the only frame.
std::optional<std::string> seer_in(const FrameTree& tree, const std::string& world) {
    constexpr double kReach = 1.0;  // [m] wheels turn, and arms do not get as far
    if (names_lidar(world) || world.starts_with("base_")) return std::nullopt;
    std::vector<std::string> moving = tree.moving_below(world);
    std::erase_if(moving, [&](const std::string& f) { return tree.reach_above(f) < kReach; });
    if (const auto lidar = only_lidar(tree, moving)) return lidar;
    std::vector<std::string> leaves = moving;
    std::erase_if(leaves, [&](const std::string& frame) {
        return !tree.fixed_below(frame).empty() || !tree.moving_below(frame).empty();
    });
    return leaves.size() == 1 ? std::optional(leaves.front()) : std::nullopt;
}

/// Some drivers give their clouds the name of the world's frame, although the points are the
/// sensor's own.
void add_in_sensor(std::vector<Candidate>& candidates) {
    const std::size_t worlds = candidates.size();
    for (std::size_t i = 0; i < worlds; ++i) {
        Candidate candidate = candidates[i];
        candidate.source.points_in_world = false;
        std::string& note = candidate.source.note;
        note = note.substr(0, note.find(", so the points")) +
               " by their headers; but as the scans show, the points are in the sensor frame";
        candidate.name += " with points in the sensor frame";
        candidates[i].name += " with points in the world frame";
        candidates.push_back(std::move(candidate));
    }
}

/// Of clouds that were moved into a frame of the world, in which their sensor moves.
std::vector<Candidate> in_world(const Question& question) {
    const auto seer = seer_in(question.contents.frames, question.sensor);
    if (!seer) return {};
    std::vector<Candidate> candidates = by_frames(question, *seer, question.sensor);
    for (Candidate& candidate : candidates) {
        candidate.source.points_in_world = true;
        candidate.source.note = fmt::format(
            "poses from /tf: frame '{}' in '{}', which is also the frame of the points, so the "
            "points are transformed into the sensor frame",
            *seer, question.sensor);
    }
    add_in_sensor(candidates);
    return candidates;
}

// Poses from topics.

/// The frame whose poses a message without the name of a frame may hold: that of the vehicle to
/// which the sensor is fixed. Empty if /tf knows none.
std::string vehicle_of(const FrameTree& tree, const std::string& sensor) {
    if (tree.moves(sensor)) return "";
    const std::vector<std::string> chain = tree.above(sensor);
    for (const char* usual : {"base_link", "base_footprint"}) {
        if (std::find(chain.begin() + 1, chain.end(), usual) != chain.end()) return usual;
    }
    return chain.size() > 1 && !names_world(chain.back()) ? chain.back() : "";
}

Candidate of_topic(const Question& question, const std::string& name, const PoseTopic& poses) {
    const auto topic = std::make_shared<const PoseTopic>(poses);
    const FrameTree& tree = question.contents.frames;
    return {{}, topic, from_topic(name, *topic, tree, question.sensor, question.lookup), name};
}

/// The readings of a topic: of several, if it does not name the frame whose poses it has.
std::vector<Candidate> of_topic(const Question& question, const Topics::value_type& named) {
    const auto& [name, topic] = named;
    std::vector<Candidate> candidates{of_topic(question, name, topic)};
    const std::string vehicle = vehicle_of(question.contents.frames, question.sensor);
    if (question.sensor == topic.parent) {
        add_in_sensor(candidates);
        return candidates;
    }
    if (!topic.child.empty() || vehicle.empty()) return candidates;
    PoseTopic of_vehicle = topic;
    of_vehicle.child = vehicle;
    candidates.push_back(of_topic(question, name, of_vehicle));
    const char* const unnamed = ", which does not name the frame whose poses it has";
    candidates[0].name += fmt::format(" as poses of '{}'", question.sensor);
    candidates[1].name += fmt::format(" as poses of '{}'", vehicle);
    candidates[0].source.note +=
        fmt::format("{}: taken for those of the sensor, '{}'", unnamed, question.sensor);
    candidates[1].source.note = fmt::format(
        "poses from {}{}: taken for those of '{}', to which '{}' is fixed by /tf_static", name,
        unnamed, vehicle, question.sensor);
    // Odometry is the vehicle's as a rule.
    if (topic.kind == MessageKind::odometry) std::swap(candidates[0], candidates[1]);
    return candidates;
}

/// Published between the first and the last scan, and shortly before and after.
std::size_t count_at(const Trajectory& poses, const std::vector<double>& stamps) {
    constexpr double kAround = 1.0;  // [s]
    const auto& of = poses.stamps;
    return static_cast<std::size_t>(
        std::upper_bound(of.begin(), of.end(), stamps.back() + kAround) -
        std::lower_bound(of.begin(), of.end(), stamps.front() - kAround));
}

/// The topics that are as good as any other: of many poses, those with the best type.
std::vector<const Topics::value_type*> best_topics(const Question& question) {
    constexpr std::size_t kMany = 10;  // a tenth of the most is as good
    const auto count = [&](const auto& topic) {
        return count_at(topic.second.trajectory, question.stamps);
    };
    std::size_t most = 0;
    for (const auto& topic : question.contents.poses) most = std::max(most, count(topic));
    std::vector<const Topics::value_type*> best;
    for (const MessageKind kind : {MessageKind::odometry, MessageKind::pose}) {
        for (const auto& topic : question.contents.poses) {
            if (topic.second.kind == kind && kMany * count(topic) >= most) best.push_back(&topic);
        }
        if (!best.empty()) return best;
    }
    return best;
}

std::string names_of(const Topics& topics) {
    std::string names;
    for (const auto& [name, topic] : topics) names += (names.empty() ? "" : ", ") + name;
    return names;
}

std::vector<Candidate> by_topics(const Question& question) {
    std::vector<Candidate> candidates;
    for (const auto* topic : best_topics(question)) {
        auto readings = of_topic(question, *topic);
        std::move(readings.begin(), readings.end(), std::back_inserter(candidates));
    }
    const Topics& all = question.contents.poses;
    if (all.size() < 2) return candidates;
    for (Candidate& candidate : candidates) {
        candidate.source.note += fmt::format(" (of {}; choose with --pose-topic)", names_of(all));
    }
    return candidates;
}

/// Poses that were published so rarely are no motion if there are others.
bool are_too_few(const std::vector<Candidate>& candidates, const Question& question) {
    constexpr std::size_t kMany = 10;
    std::size_t most = 0, of_frames = 0;
    for (const auto& [name, topic] : question.contents.poses) {
        most = std::max(most, count_at(topic.trajectory, question.stamps));
    }
    for (const Candidate& c : candidates) of_frames = std::max(of_frames, c.source.stamps.size());
    return kMany * of_frames < most;
}

BagPoses wanted_poses(const Question& question, const std::string& wanted) {
    const Topics& topics = question.contents.poses;
    std::vector<Candidate> frames = by_frames(question, question.sensor);
    if (frames.empty()) frames = in_world(question);
    if (wanted == "/tf" && !frames.empty()) return best_of(std::move(frames), question);
    const auto named = topics.find(wanted);
    if (named != topics.end()) return best_of(of_topic(question, *named), question);
    std::string known = names_of(topics);
    if (!frames.empty()) known += (known.empty() ? "" : ", ") + std::string("/tf");
    throw ConfigError(
        fmt::format("no poses on topic {}; there are: {}", wanted, known.empty() ? "none" : known));
}

bool is_frame_of_poses(const Topics& topics, const std::string& frame) {
    return std::any_of(topics.begin(), topics.end(),
                       [&](const auto& topic) { return topic.second.parent == frame; });
}

}  // namespace

bool names_lidar(std::string frame) {
    std::transform(frame.begin(), frame.end(), frame.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array<std::string_view, 9> kNames = {"lidar",  "laser",     "velodyne",
                                                        "ouster", "os_sensor", "hesai",
                                                        "pandar", "livox",     "robosense"};
    return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
        return frame.find(name) != std::string::npos;
    });
}

std::optional<std::string> only_lidar(const FrameTree& tree, std::vector<std::string> frames) {
    std::erase_if(frames, [](const std::string& frame) { return !names_lidar(frame); });
    const std::vector<std::string> named = frames;
    std::erase_if(frames, [&](const std::string& frame) {
        return std::any_of(named.begin(), named.end(), [&](const std::string& other) {
            const auto chain = tree.above(other);
            return other != frame && std::find(chain.begin(), chain.end(), frame) != chain.end();
        });
    });
    return frames.size() == 1 ? std::optional(frames.front()) : std::nullopt;
}

BagPoses choose_poses(const BagContents& contents, const std::string& sensor,
                      const std::vector<double>& stamps, const std::string& wanted,
                      const std::function<Cloud(std::size_t)>& read) {
    const Question question{contents, sensor, stamps, read,
                            LinkLookup{.gap = limits_for(stamps).apart, .holds = true}};
    if (!wanted.empty()) return wanted_poses(question, wanted);
    std::vector<Candidate> candidates = by_frames(question, sensor);
    if (are_too_few(candidates, question)) candidates.clear();
    if (candidates.empty() && !is_frame_of_poses(contents.poses, sensor)) {
        candidates = in_world(question);
    }
    if (candidates.empty()) candidates = by_topics(question);
    if (candidates.empty()) candidates = standing_still(question);
    if (!candidates.empty()) return best_of(std::move(candidates), question);
    BagPoses none;
    none.notes.push_back(
        fmt::format("no poses of the frame '{}' found; looked for /tf that leads to it, "
                    "nav_msgs/Odometry, geometry_msgs/PoseStamped",
                    sensor));
    return none;
}

}  // namespace dynamic_filter::io
