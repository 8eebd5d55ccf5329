// SPDX-License-Identifier: MIT
/// Chooses the topics that the filter needs, and follows publishers that come and go.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "live/intake.hpp"

namespace dynamic_filter::live {

/// What others publish that the filter can use.
struct UsableTopics {
    std::vector<SeenTopic> clouds, poses, transforms;
    std::vector<SeenTopic> packets;  ///< raw data of sensors, for which a driver is needed
};
/// Sorts topics by their use. What another instance of this program publishes is left out.
UsableTopics usable(const std::vector<SeenTopic>& seen);

std::vector<std::string> names_of(const std::vector<SeenTopic>& topics);

/// True for a topic whose transforms hold forever.
bool is_static_transforms(const std::string& topic);

/// What to ask for: as much as all publishers offer, or what `qos` says.
Quality quality_for(const SeenTopic& topic, const std::string& qos);

/// Single caller.
class Subscriptions {
public:
    Subscriptions(Bus& bus, const LiveConfig& config, Intake& intake)
        : bus_(bus), config_(config), intake_(intake) {}
    ~Subscriptions() { bus_.stop(); }  // before what receives its messages goes
    Subscriptions(const Subscriptions&) = delete;
    Subscriptions& operator=(const Subscriptions&) = delete;

    /// Subscribes to what is there by now. Call it about once a second, at first more often.
    /// Throws ConfigError if several topics could hold the scans.
    void update();

    /// The topics of the scans that are there by now.
    [[nodiscard]] const std::vector<std::string>& clouds() const { return clouds_; }
    /// The first of them; empty: none yet.
    [[nodiscard]] std::string cloud() const { return clouds_.empty() ? "" : clouds_.front(); }
    /// The topics of input.cloud that nobody publishes by now.
    [[nodiscard]] std::vector<std::string> missing() const;
    std::vector<std::string> pop_notices() { return std::exchange(notices_, {}); }

private:
    void choose_clouds(const UsableTopics& topics);
    void tell_missing();
    [[nodiscard]] bool is_chosen(const std::string& topic) const;
    void subscribe(const SeenTopic& topic);

    Bus& bus_;
    const LiveConfig& config_;
    Intake& intake_;
    std::vector<std::string> clouds_;
    std::optional<std::chrono::steady_clock::time_point> first_seen_;
    bool told_missing_ = false;
    std::map<std::string, Quality> subscribed_;  // keys: topics
    std::vector<std::string> notices_;
};

}  // namespace dynamic_filter::live
