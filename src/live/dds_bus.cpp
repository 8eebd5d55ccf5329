// SPDX-License-Identifier: MIT
#include "live/dds_bus.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "live/dds_configuration.hpp"
#include "live/dds_log.hpp"
#include "live/dds_qos.hpp"
#include "live/dds_service.hpp"
#include "live/dds_type.hpp"

namespace dynamic_filter::live {

namespace {

constexpr int kMostDomain = 232;  // beyond it, port numbers end

/// A domain of DDS exists once in a process, whichever bus has made it, and has the configuration
/// that it was made with.
class SharedDomains {
public:
    /// Returns an error code below 0 if the domain cannot be made.
    dds_return_t join(int id, const std::string& configuration) {
        const std::lock_guard hold(lock_);
        Domain& domain = domains_[id];
        if (domain.users == 0) {
            domain.entity =
                dds_create_domain(static_cast<dds_domainid_t>(id), configuration.c_str());
        }
        if (domain.entity >= 0) ++domain.users;
        return domain.entity;
    }
    void leave(int id) {
        const std::lock_guard hold(lock_);
        Domain& domain = domains_[id];
        if (--domain.users == 0) dds_delete(domain.entity);
    }

private:
    struct Domain {
        dds_entity_t entity = 0;
        int users = 0;
    };
    std::mutex lock_;
    std::map<int, Domain> domains_;
};

SharedDomains& shared_domains() {
    static SharedDomains domains;
    return domains;
}

}  // namespace

std::string dds_topic_name(const std::string& topic) {
    return "rt" + (topic.starts_with('/') ? topic : "/" + topic);
}

std::string dds_type_name(const std::string& type) {
    const std::size_t slash = type.find('/');
    return type.substr(0, slash) + "::msg::dds_::" + type.substr(slash + 1) + "_";
}

std::string topic_of_dds(const std::string& name) {
    return name.starts_with("rt/") ? name.substr(2) : "";
}

std::string type_of_dds(const std::string& name) {
    constexpr std::string_view kMiddle = "::msg::dds_::";
    const std::size_t at = name.find(kMiddle);
    if (at == std::string::npos || !name.ends_with('_')) return "";
    const std::size_t type = at + kMiddle.size();
    return name.substr(0, at) + "/" + name.substr(type, name.size() - 1 - type);
}

struct DdsBus::Engine {
    struct Reader {
        io::Topic topic;
        dds_entity_t entity = 0;
        Receive receive;
    };
    DdsOptions options;
    bool has_joined = false;  // a shared domain
    dds_entity_t participant = 0, publications = 0, waitset = 0, stop = 0;
    dds_guid_t own{};
    mutable std::mutex lock;                     // guards the members below
    std::map<std::string, dds_entity_t> topics;  // keys: name and type on the wire
    std::map<std::string, dds_entity_t> writers;
    std::map<std::string, std::shared_ptr<Reader>> readers;
    std::uint64_t lost_before = 0;  // by readers that were replaced
    std::thread thread;
    std::vector<std::unique_ptr<DdsService>> services;

    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    ~Engine() {
        stop_receiving();
        services.clear();
        if (participant > 0) dds_delete(participant);
        if (has_joined) shared_domains().leave(options.domain);
    }

    void stop_receiving() {
        for (const auto& service : services) service->stop();
        if (!thread.joinable()) return;
        dds_set_guardcondition(stop, true);
        thread.join();
    }

    dds_entity_t topic_for(const io::Topic& topic) {
        const std::string name = dds_topic_name(topic.name), type = dds_type_name(topic.type);
        dds_entity_t& entity = topics[name + " " + type];
        if (entity <= 0) {
            entity = create_topic_of_bytes(participant, name, type);
            require(entity, "topic " + topic.name);
        }
        return entity;
    }

    static std::uint64_t lost_by(dds_entity_t reader) {
        dds_sample_lost_status_t status{};
        return dds_get_sample_lost_status(reader, &status) == 0 ? status.total_count : 0;
    }

    std::shared_ptr<Reader> reader_of(dds_entity_t entity) const {
        const std::lock_guard hold(lock);
        for (const auto& [name, reader] : readers) {
            if (reader->entity == entity) return reader;
        }
        return nullptr;
    }

    void run() {
        constexpr std::size_t kMost = 64;
        std::array<dds_attach_t, kMost> ready{};
        while (true) {
            const auto count = dds_waitset_wait(waitset, ready.data(), kMost, DDS_SECS(1));
            bool stopped = false;
            dds_read_guardcondition(stop, &stopped);
            if (stopped) return;
            for (int i = 0; i < std::min<int>(count, kMost); ++i) {
                const auto reader =
                    reader_of(static_cast<dds_entity_t>(ready[static_cast<std::size_t>(i)]));
                // One message of each topic at a time, so that no topic holds up the others.
                if (!reader) continue;
                if (const auto message = pop_bytes(reader->entity)) {
                    reader->receive(reader->topic, *message);
                }
            }
        }
    }
};

DdsBus::DdsBus(const DdsOptions& options) : engine_(std::make_unique<Engine>()) {
    Engine& e = *engine_;
    e.options = options;
    if (options.domain < 0 || options.domain > kMostDomain) {
        throw ConfigError(
            fmt::format("bus.domain is {}; expected 0 to {}", options.domain, kMostDomain));
    }
    keep_dds_log();
    const char* const uri = std::getenv("CYCLONEDDS_URI");
    const bool by_user = options.network.empty() && uri != nullptr && *uri != '\0';
    if (!by_user) {
        if (e.options.network.empty()) e.options.network = "localhost";
        require(shared_domains().join(options.domain,
                                      dds_configuration(e.options.network, options.domain)),
                fmt::format("cannot join DDS domain {} on network '{}'", options.domain,
                            e.options.network));
        e.has_joined = true;
    }
    e.participant =
        dds_create_participant(static_cast<dds_domainid_t>(options.domain), nullptr, nullptr);
    require(e.participant, fmt::format("cannot join DDS domain {}", options.domain));
    dds_get_guid(e.participant, &e.own);
    e.publications =
        dds_create_reader(e.participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
    require(e.publications, "cannot look for publishers");
    e.waitset = dds_create_waitset(e.participant);
    e.stop = dds_create_guardcondition(e.participant);
    require(dds_waitset_attach(e.waitset, e.stop, e.stop), "cannot wait for messages");
    e.thread = std::thread([&e] { e.run(); });
}

void DdsBus::stop() { engine_->stop_receiving(); }

DdsBus::~DdsBus() = default;

std::string DdsBus::description() const {
    const std::string& network = engine_->options.network;
    return fmt::format("ROS 2, DDS domain {}, {}", engine_->options.domain,
                       network.empty()          ? "network as CYCLONEDDS_URI says"
                       : network == "localhost" ? "this machine only"
                       : network == "all"       ? "the network of the default interface"
                                                : "network " + network);
}

void DdsBus::advertise(const io::Topic& topic, const Quality& quality) {
    const std::lock_guard hold(engine_->lock);
    const dds_entity_t writer = dds_create_writer(engine_->participant, engine_->topic_for(topic),
                                                  qos_of_writer(quality).get(), nullptr);
    require(writer, "cannot publish " + topic.name);
    const auto [it, fresh] = engine_->writers.emplace(topic.name, writer);
    if (!fresh) dds_delete(std::exchange(it->second, writer));
}

bool DdsBus::is_wanted(const std::string& topic) const {
    const std::lock_guard hold(engine_->lock);
    const auto writer = engine_->writers.find(topic);
    dds_publication_matched_status_t status{};
    return writer != engine_->writers.end() &&
           dds_get_publication_matched_status(writer->second, &status) == 0 &&
           status.current_count > 0;
}

bool DdsBus::publish(const std::string& topic, double, const Bytes& message) {
    dds_entity_t writer = 0;
    {
        const std::lock_guard hold(engine_->lock);
        const auto found = engine_->writers.find(topic);
        if (found == engine_->writers.end()) return false;
        writer = found->second;
    }
    return write_bytes(writer, message) == 0;
}

std::vector<SeenTopic> DdsBus::seen() const {
    std::map<std::pair<std::string, std::string>, SeenTopic> topics;
    constexpr std::size_t kMost = 1024;  // publishers
    std::vector<void*> samples(kMost, nullptr);
    std::vector<dds_sample_info_t> infos(kMost);
    const auto count =
        dds_read_mask(engine_->publications, samples.data(), infos.data(), kMost, kMost,
                      DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
    for (std::size_t i = 0; count > 0 && i < static_cast<std::size_t>(count); ++i) {
        const auto& found = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
        const bool is_own =
            std::memcmp(&found.participant_key, &engine_->own, sizeof engine_->own) == 0;
        if (!infos[i].valid_data || is_own) continue;
        const std::string name = topic_of_dds(found.topic_name),
                          type = type_of_dds(found.type_name);
        if (name.empty() || type.empty()) continue;
        const Quality offered = quality_of(found.qos);
        SeenTopic& topic =
            topics.try_emplace({name, type}, SeenTopic{name, type, 0, offered}).first->second;
        ++topic.publishers;
        topic.offered.reliable = topic.offered.reliable && offered.reliable;
        topic.offered.latched = topic.offered.latched && offered.latched;
    }
    if (count > 0) dds_return_loan(engine_->publications, samples.data(), count);
    std::vector<SeenTopic> list;
    for (auto& [key, topic] : topics) list.push_back(std::move(topic));
    return list;
}

void DdsBus::subscribe(const io::Topic& topic, const Quality& quality, Receive receive) {
    Engine& e = *engine_;
    const std::lock_guard hold(e.lock);
    auto reader = std::make_shared<Engine::Reader>();
    reader->topic = topic;
    reader->receive = std::move(receive);
    reader->entity =
        dds_create_reader(e.participant, e.topic_for(topic), qos_of_reader(quality).get(), nullptr);
    require(reader->entity, "cannot subscribe to " + topic.name);
    const dds_entity_t condition = dds_create_readcondition(reader->entity, DDS_ANY_STATE);
    require(dds_waitset_attach(e.waitset, condition, reader->entity), "cannot wait for messages");
    std::shared_ptr<Engine::Reader>& current = e.readers[topic.name];
    if (current) {
        e.lost_before += Engine::lost_by(current->entity);
        dds_delete(current->entity);
    }
    current = std::move(reader);
}

void DdsBus::serve(const std::string& name, const ServiceType& type, Serve serve) {
    auto service = std::make_unique<DdsService>(engine_->participant, name, type, std::move(serve));
    const std::lock_guard hold(engine_->lock);
    engine_->services.push_back(std::move(service));
}

Bytes DdsBus::call(const std::string& name, const ServiceType& type, const WriteRequest& write,
                   const Patience& patience) {
    return call_service(engine_->participant, name, type, write, patience);
}

std::vector<std::string> DdsBus::pop_notices() {
    std::vector<std::string> notices = pop_dds_log();
    for (std::string& notice : notices) notice.insert(0, "DDS: ");
    return notices;
}

std::uint64_t DdsBus::lost() const {
    const std::lock_guard hold(engine_->lock);
    std::uint64_t lost = engine_->lost_before;
    for (const auto& [name, reader] : engine_->readers) lost += Engine::lost_by(reader->entity);
    return lost;
}

}  // namespace dynamic_filter::live
