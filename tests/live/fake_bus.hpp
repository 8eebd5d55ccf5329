// SPDX-License-Identifier: MIT
/// A bus in memory: a test says what others publish, and sees what is published.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "live/bus.hpp"

namespace dynamic_filter::live::test {

class FakeBus final : public Bus {
public:
    io::MessageEncoding used = io::MessageEncoding::cdr;
    std::vector<SeenTopic> others;
    bool wanted = true, takes = true;
    std::map<std::string, Quality> advertised;
    std::map<std::string, Quality> subscribed;
    std::map<std::string, std::size_t> subscriptions;
    std::map<std::string, Receive> receivers;
    std::map<std::string, std::pair<ServiceType, Serve>> services;
    bool stopped = false;

    void advertise(const io::Topic& topic, const Quality& quality) override {
        advertised[topic.name] = quality;
    }
    [[nodiscard]] bool is_wanted(const std::string&) const override { return wanted; }
    bool publish(const std::string& topic, double, const Bytes& message) override {
        const std::lock_guard hold(lock_);
        published_[topic].push_back(message);
        return takes;
    }
    [[nodiscard]] io::MessageEncoding encoding() const override { return used; }
    [[nodiscard]] std::string description() const override { return "a bus in memory"; }
    [[nodiscard]] std::vector<SeenTopic> seen() const override { return others; }
    void subscribe(const io::Topic& topic, const Quality& quality, Receive receive) override {
        subscribed[topic.name] = quality;
        ++subscriptions[topic.name];
        receivers[topic.name] = std::move(receive);
    }
    void serve(const std::string& name, const ServiceType& type, Serve serve) override {
        services[name] = {type, std::move(serve)};
    }
    void stop() override { stopped = true; }
    [[nodiscard]] std::uint64_t lost() const override { return 0; }
    std::vector<std::string> pop_notices() override { return {}; }
    std::vector<std::pair<std::string, std::string>> pop_parameters() override { return {}; }

    [[nodiscard]] std::vector<Bytes> published(const std::string& topic) const {
        const std::lock_guard hold(lock_);
        const auto found = published_.find(topic);
        return found == published_.end() ? std::vector<Bytes>{} : found->second;
    }

private:
    mutable std::mutex lock_;
    std::map<std::string, std::vector<Bytes>> published_;
};

}  // namespace dynamic_filter::live::test
