// SPDX-License-Identifier: MIT
#include "recording/bag_clouds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "formats/messages/packets.hpp"

namespace dynamic_filter::io {
namespace {

template <class Topics>
std::string topic_names(const Topics& topics) {
    std::string names;
    for (const auto& [name, topic] : topics) names += (names.empty() ? "" : ", ") + name;
    return names;
}

/// True for output topics of `convert`, which repeat the scans of another topic or of all topics.
bool is_part_of_another(const std::string& name, const std::map<std::string, CloudTopic>& clouds) {
    if (name == "/static_map" && clouds.size() > 1) return true;
    for (const std::string_view part : {"_static", "_dynamic"}) {
        if (name.ends_with(part) && clouds.contains(name.substr(0, name.size() - part.size()))) {
            return true;
        }
    }
    return false;
}

/// Text such as "; /velodyne_packets is velodyne_msgs/VelodyneScan..." for topics with raw packets
/// that a driver must decode first, and with clouds of types that are not read.
std::string tell_packets(const BagContents& contents) {
    std::string told;
    for (const auto& [name, type] : contents.packets) {
        told += fmt::format(
            "; {} holds raw packets ({}): play the bag to the driver's node {} and record the "
            "sensor_msgs/PointCloud2 that it publishes",
            name, type, driver_of(type));
    }
    for (const auto& [name, type] : contents.other_clouds)
        told +=
            fmt::format("; {} holds {}, which is not read: {}", name, type, advice_on_cloud(type));
    return told;
}

const CloudTopic& choose_topic(const BagContents& contents, const std::filesystem::path& data,
                               const std::string& wanted) {
    const auto& clouds = contents.clouds;
    if (!wanted.empty()) {
        const auto found = clouds.find(wanted);
        if (found != clouds.end()) return found->second;
        throw ConfigError(fmt::format("no point clouds on topic {}; there are: {}{}", wanted,
                                      clouds.empty() ? "none" : topic_names(clouds),
                                      tell_packets(contents)));
    }
    if (clouds.empty()) {
        const auto& known = contents.losses.empty() ? contents.notes : contents.losses;
        const std::string why = known.empty() ? "" : " (" + known.front() + ")";
        throw InputError(data, "",
                         "holds no point clouds (sensor_msgs/PointCloud2 or Livox's CustomMsg)" +
                             why + tell_packets(contents));
    }
    std::vector<const CloudTopic*> whole;
    for (const auto& [name, topic] : clouds) {
        if (!is_part_of_another(name, clouds)) whole.push_back(&topic);
    }
    if (whole.size() > 1) {
        std::string names;
        for (const auto& [name, topic] : clouds) {
            names +=
                fmt::format("{}{} ({} scans)", names.empty() ? "" : ", ", name, topic.scans.size());
        }
        throw ConfigError("point clouds on several topics: " + names + "; choose one with --topic");
    }
    return *whole.front();
}

/// Orders scans by the stamps of their headers, or by the time of recording if the driver left the
/// stamps at zero.
void put_in_order(BagClouds& clouds) {
    auto& scans = clouds.scans;
    const bool unset =
        std::all_of(scans.begin(), scans.end(), [](const FoundScan& s) { return s.stamp == 0.0; });
    if (unset) {
        for (FoundScan& scan : scans) scan.stamp = 1e-9 * static_cast<double>(scan.recorded_ns);
        clouds.notes.push_back("headers have no stamps; the times of recording are used");
    }
    std::stable_sort(scans.begin(), scans.end(),
                     [](const FoundScan& a, const FoundScan& b) { return a.stamp < b.stamp; });
}

/// True if messages have the same bytes but for the number and the stamp of their headers, which
/// both encodings have first.
bool are_alike(const Bag& bag, const FoundScan& a, const FoundScan& b) {
    constexpr std::size_t kStamped = 12, kFewBytes = 4096;  // too few for a scan like no other
    if (a.bytes != b.bytes || a.end != b.end || a.bytes < kFewBytes) return false;
    try {
        const std::vector<std::byte> of_a = bag.read(a.ref), of_b = bag.read(b.ref);
        return std::equal(of_a.begin() + kStamped, of_a.end(), of_b.begin() + kStamped, of_b.end());
    } catch (const InputError&) {
        return false;
    }
}

/// Leaves out clouds that the bag holds twice, as it does if it was recorded while another one was
/// played, and if two recorders ran.
void drop_copies(BagClouds& clouds, const Bag& bag) {
    std::vector<FoundScan> kept;
    for (FoundScan& scan : clouds.scans) {
        bool is_copy = false;
        for (std::size_t k = kept.size(); k-- > 0 && kept[k].stamp == scan.stamp && !is_copy;) {
            is_copy = are_alike(bag, kept[k], scan);
        }
        if (!is_copy) kept.push_back(std::move(scan));
    }
    const std::size_t copies = clouds.scans.size() - kept.size();
    clouds.scans = std::move(kept);
    if (copies == 0) return;
    clouds.notes.push_back(fmt::format(
        "{} clouds are in the bag more than once, with the same stamp and the same bytes; their "
        "copies are left out",
        copies));
}

/// See repeats_among() for files. Several sensors take turns.
std::vector<std::uint8_t> repeats_in(const std::vector<FoundScan>& scans, const Bag& bag) {
    std::vector<std::uint8_t> repeats(scans.size(), 0);
    std::map<std::string, std::size_t> last;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto [before, fresh] = last.try_emplace(scans[i].frame, i);
        repeats[i] = !fresh && are_alike(bag, scans[before->second], scans[i]) ? 1 : 0;
        before->second = i;
    }
    const auto count = std::accumulate(repeats.begin(), repeats.end(), std::size_t{0});
    if (count == 0 || 2 * count > scans.size()) return {};
    return repeats;
}

using Frames = std::vector<std::pair<std::string, std::size_t>>;

/// The frames of the clouds with their numbers, the one with most clouds first.
Frames frames_of(const std::vector<FoundScan>& scans) {
    Frames frames;
    for (const FoundScan& scan : scans) {
        const auto found = std::find_if(frames.begin(), frames.end(),
                                        [&](const auto& f) { return f.first == scan.frame; });
        if (found == frames.end()) {
            frames.emplace_back(scan.frame, 1);
        } else {
            ++found->second;
        }
    }
    std::stable_sort(frames.begin(), frames.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    return frames;
}

/// "'front' (60 clouds), 'rear' (60 clouds)"
std::string text_of(const Frames& frames) {
    std::string text;
    for (const auto& [frame, count] : frames) {
        text += fmt::format("{}'{}' ({} clouds)", text.empty() ? "" : ", ", frame, count);
    }
    return text;
}

void keep_frame(BagClouds& clouds, const std::string& frame) {
    std::vector<FoundScan> kept;
    std::vector<std::uint8_t> repeats;
    for (std::size_t i = 0; i < clouds.scans.size(); ++i) {
        if (clouds.scans[i].frame != frame) continue;
        kept.push_back(std::move(clouds.scans[i]));
        if (!clouds.repeats.empty()) repeats.push_back(clouds.repeats[i]);
    }
    clouds.scans = std::move(kept);
    clouds.repeats = std::move(repeats);
    clouds.frames = {frame};
}

void keep_wanted(BagClouds& clouds, const Frames& frames, const std::string& wanted) {
    keep_frame(clouds, wanted);
    if (clouds.scans.empty()) {
        throw ConfigError(
            fmt::format("no point clouds in the frame '{}' on topic {}; there are: {}", wanted,
                        clouds.topic.name, text_of(frames)));
    }
    clouds.notes.push_back(fmt::format("only clouds in the frame '{}' are read", wanted));
}

}  // namespace

BagClouds choose_clouds(const Bag& bag, const BagContents& contents,
                        const std::filesystem::path& data, const std::string& wanted) {
    const auto at = contents.clouds.contains(wanted) ? std::string::npos : wanted.find('@');
    const std::string name = wanted.substr(0, at);
    const CloudTopic& topic = choose_topic(contents, data, name);
    BagClouds clouds{.topic = topic.topic, .scans = topic.scans};
    clouds.notes.push_back("scans from " + topic.topic.name);
    put_in_order(clouds);
    const Frames frames = frames_of(clouds.scans);
    for (const auto& [frame, count] : frames) clouds.frames.push_back(frame);
    if (at != std::string::npos) keep_wanted(clouds, frames, wanted.substr(at + 1));
    drop_copies(clouds, bag);
    clouds.repeats = repeats_in(clouds.scans, bag);
    return clouds;
}

void keep_first_frame(BagClouds& clouds) {
    if (clouds.frames.size() < 2) return;
    const Frames frames = frames_of(clouds.scans);
    const std::string first = clouds.frames.front(), topic = clouds.topic.name;
    std::string others;
    for (const auto& [frame, count] : frames) {
        if (frame == first) continue;
        others += fmt::format("{}--topic {}@{}", others.empty() ? "" : " or ", topic, frame);
    }
    keep_frame(clouds, first);
    clouds.losses.push_back(fmt::format(
        "the topic {} carries clouds of {} frames, those of several sensors: {}; only those in "
        "'{}' are read; {} reads the others",
        topic, frames.size(), text_of(frames), first, others));
}

}  // namespace dynamic_filter::io
