// SPDX-License-Identifier: MIT
#include "live/subscriptions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dynamic_filter/error.hpp"
#include "formats/messages/messages.hpp"
#include "formats/messages/packets.hpp"

namespace dynamic_filter::live {

namespace {

bool is_listed(const std::vector<SeenTopic>& topics, const std::string& name) {
    return std::any_of(topics.begin(), topics.end(),
                       [&](const SeenTopic& t) { return t.name == name; });
}

/// Only this program publishes corrections beside labels.
bool is_of_another_instance(const std::vector<SeenTopic>& seen, const std::string& name) {
    const std::string prefix = name.substr(0, name.rfind('/'));
    return is_listed(seen, prefix + "/corrections") && is_listed(seen, prefix + "/labels");
}

}  // namespace

std::vector<std::string> names_of(const std::vector<SeenTopic>& topics) {
    std::vector<std::string> names;
    for (const SeenTopic& topic : topics) names.push_back(topic.name);
    return names;
}

UsableTopics usable(const std::vector<SeenTopic>& seen) {
    UsableTopics topics;
    for (const SeenTopic& topic : seen) {
        switch (io::kind_of(topic.type)) {
            case io::MessageKind::cloud:
            case io::MessageKind::livox:
                if (!is_of_another_instance(seen, topic.name)) topics.clouds.push_back(topic);
                break;
            case io::MessageKind::odometry:
            case io::MessageKind::pose:
                topics.poses.push_back(topic);
                break;
            case io::MessageKind::transforms:
                topics.transforms.push_back(topic);
                break;
            case io::MessageKind::other:
                if (!io::driver_of(topic.type).empty()) topics.packets.push_back(topic);
                break;
        }
    }
    return topics;
}

bool is_static_transforms(const std::string& topic) { return topic.ends_with("tf_static"); }

Quality quality_for(const SeenTopic& topic, const std::string& qos) {
    constexpr std::size_t kClouds = 5, kOthers = 200;
    const bool is_cloud = io::holds_scan(io::kind_of(topic.type));
    Quality quality{.reliable = topic.offered.reliable,
                    .latched = topic.offered.latched && is_static_transforms(topic.name),
                    .depth = is_cloud ? kClouds : kOthers};
    if (qos != "auto") quality.reliable = qos == "reliable";
    return quality;
}

void Subscriptions::update() {
    const UsableTopics topics = usable(bus_.seen());
    choose_clouds(topics);
    for (const SeenTopic& topic : topics.clouds) {
        if (is_chosen(topic.name)) subscribe(topic);
    }
    for (const SeenTopic& topic : topics.transforms) subscribe(topic);
    const bool undecided = intake_.origin() == PoseOrigin::undecided;
    for (const SeenTopic& topic : topics.poses) {
        const bool known = subscribed_.contains(topic.name);
        if (undecided || known || topic.name == config_.input.pose) subscribe(topic);
    }
}

void Subscriptions::choose_clouds(const UsableTopics& topics) {
    for (const std::string& name : missing()) {
        if (is_listed(topics.clouds, name)) clouds_.push_back(name);
    }
    tell_missing();
    if (!config_.input.cloud.empty() || !clouds_.empty() || topics.clouds.empty()) return;
    // Others may be found a moment later.
    constexpr auto kMoment = std::chrono::milliseconds(1000);
    const auto now = std::chrono::steady_clock::now();
    if (!first_seen_) first_seen_ = now;
    if (now - *first_seen_ < kMoment) return;
    if (topics.clouds.size() > 1) {
        throw ConfigError(
            fmt::format("several topics have point clouds: {}; choose one with --set "
                        "input.cloud=TOPIC, or name "
                        "all sensors of the vehicle",
                        fmt::join(names_of(topics.clouds), ", ")));
    }
    clouds_.push_back(topics.clouds.front().name);
}

bool Subscriptions::is_chosen(const std::string& topic) const {
    return std::find(clouds_.begin(), clouds_.end(), topic) != clouds_.end();
}

std::vector<std::string> Subscriptions::missing() const {
    std::vector<std::string> topics = cloud_topics(config_);
    std::erase_if(topics, [&](const std::string& topic) { return is_chosen(topic); });
    return topics;
}

/// Once, if one of several sensors is not there a while after the first.
void Subscriptions::tell_missing() {
    constexpr auto kWhile = std::chrono::seconds(3);
    const std::vector<std::string> topics = missing();
    if (clouds_.empty() || topics.empty() || told_missing_) return;
    const auto now = std::chrono::steady_clock::now();
    if (!first_seen_) first_seen_ = now;
    if (now - *first_seen_ < kWhile) return;
    told_missing_ = true;
    for (const std::string& name : topics) {
        notices_.push_back(fmt::format(
            "nobody publishes scans on {}; those of the other sensors are filtered", name));
    }
}

/// Again if a publisher came that offers less than was asked for: it would not be heard.
void Subscriptions::subscribe(const SeenTopic& topic) {
    const Quality quality = quality_for(topic, config_.input.qos);
    const auto before = subscribed_.find(topic.name);
    if (before != subscribed_.end()) {
        const bool is_enough = (quality.reliable || !before->second.reliable) &&
                               (quality.latched || !before->second.latched);
        if (is_enough) return;
        notices_.push_back(
            fmt::format("a publisher of {} offers less than the others ({}), so the "
                        "topic is subscribed anew",
                        topic.name, quality.reliable ? "not latched" : "best effort"));
    }
    subscribed_[topic.name] = quality;
    const bool is_static = is_static_transforms(topic.name);
    bus_.subscribe({topic.name, topic.type, bus_.encoding()}, quality,
                   [this, is_static](const io::Topic& from, const Bytes& message) {
                       intake_.put(from, is_static, message);
                   });
}

}  // namespace dynamic_filter::live
