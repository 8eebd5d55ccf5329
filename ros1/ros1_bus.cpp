// SPDX-License-Identifier: MIT
#include "ros1/ros1_bus.hpp"

#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>

#include "dynamic_filter/error.hpp"
#include "formats/messages/definitions.hpp"
#include "ros1/raw_message.hpp"
#include "ros1/raw_service.hpp"
#include "ros1/ros_node.hpp"

namespace ros::master {
void init(const M_string& remappings);  // in the library, but in none of its headers
}

namespace dynamic_filter::live {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kWatchPeriod{0.5};
constexpr double kLongestRegistration = 1.0;  // [s] that roscpp may wait for a lost master

/// roscpp ends the process if the address is missing or wrong.
std::string master_uri(const std::map<std::string, std::string>& remappings) {
    setenv("ROS_MASTER_URI", "http://localhost:11311", 0);
    const char* const by_user = std::getenv("ROS_MASTER_URI");
    const auto remapped = remappings.find("__master");
    std::string uri = by_user == nullptr ? "" : by_user;
    if (remapped != remappings.end()) uri = remapped->second;
    std::string host;
    std::uint32_t port = 0;
    if (ros::network::splitURI(uri, host, port)) return uri;
    throw ConfigError(fmt::format(
        "ROS_MASTER_URI is '{}'; expected an address such as http://localhost:11311", uri));
}

void wait_for_master(const std::string& uri, double wait) {
    const auto end = std::chrono::steady_clock::now() + Seconds(wait);
    while (!RosClient(uri).call("getPid", {"/dynamicfilter"})) {
        if (std::chrono::steady_clock::now() > end) {
            throw Error(fmt::format("no master at {}; start roscore, or set ROS_MASTER_URI", uri));
        }
        std::this_thread::sleep_for(Seconds(0.1));
    }
}

std::uint32_t queue_size(const Quality& quality) {
    return static_cast<std::uint32_t>(std::max<std::size_t>(quality.depth, 1));  // 0: no limit
}

}  // namespace

struct Ros1Bus::Engine {
    struct Subscription {
        ros::SubscribeOptions options;
        ros::Subscriber subscriber;  // empty while the master is lost
    };

    struct Service {
        ros::AdvertiseServiceOptions options;
        ros::ServiceServer server;
    };

    std::string master;
    RosNode itself;
    std::vector<std::string> watched;
    ros::CallbackQueue queue, calls;  // of messages, and of services, which may take their time
    std::optional<ros::NodeHandle> node;

    std::mutex changing;      // one change of subscriptions and services at a time
    mutable std::mutex lock;  // guards the members below; no calls of ROS meanwhile
    std::map<std::string, ros::Publisher> publishers;
    std::map<std::string, Subscription> subscriptions;
    std::vector<Service> services;
    std::map<int, std::uint64_t> dropped;  // messages, of each connection so far
    std::map<std::string, std::string> parameters, news;
    std::vector<std::string> notices;
    bool stopping = false;
    std::condition_variable stop;

    // The state of the watching thread.
    bool is_there = true, is_registered = true;

    std::thread receiving, serving, watching;

    Engine(const std::map<std::string, std::string>& remappings, std::vector<std::string> followed,
           double wait)
        : master(master_uri(remappings)), watched(std::move(followed)) {
        if (ros::isInitialized()) throw Error("a process can be one node of ROS 1 only");
        wait_for_master(master, wait);
        join_ros(remappings);
        itself = {ros::this_node::getName(), ros::XMLRPCManager::instance()->getServerURI()};
        RosClient client(master);
        parameters = news = private_parameters(client, itself);
        receiving = std::thread([this] { receive(queue); });
        serving = std::thread([this] { receive(calls); });
        watching = std::thread([this] { watch(); });
    }

    ~Engine() {
        {
            const std::lock_guard hold(lock);
            stopping = true;
        }
        stop.notify_all();
        queue.disable();
        calls.disable();
        for (std::thread* thread : {&watching, &receiving, &serving}) {
            if (thread->joinable()) thread->join();
        }
        if (!ros::isStarted()) return;
        if (!RosClient(master).call("getPid", {itself.name})) {
            // roscpp would wait without an end for a master that hangs; nobody listens here.
            ros::master::init({{"__master", "http://127.0.0.1:1"}});
        }
        subscriptions.clear();
        services.clear();
        publishers.clear();
        node.reset();
        ros::shutdown();
    }

    void join_ros(const std::map<std::string, std::string>& remappings) {
        try {
            ros::init(remappings, "dynamicfilter", ros::init_options::NoSigintHandler);
            ros::master::setRetryTimeout(ros::WallDuration(kLongestRegistration));
            // roscpp would leave at once; so the program can end as by a signal.
            ros::XMLRPCManager::instance()->bind("shutdown", [this](auto& request, auto& result) {
                const auto arguments = list_of(request);
                say(fmt::format("ROS asks this node to end: {}",
                                arguments.size() > 1 ? text_of(arguments[1]) : "no reason given"));
                result[0] = 1;
                result[1] = "";
                result[2] = 0;
                kill(getpid(), SIGTERM);
            });
            ros::start();
            node.emplace();
        } catch (const ros::Exception& error) {
            throw ConfigError(fmt::format("ROS 1: {}", error.what()));
        }
    }

    void say(const std::string& text) {
        const std::lock_guard hold(lock);
        notices.push_back(text);
    }

    bool is_stopping() const {
        const std::lock_guard hold(lock);
        return stopping;
    }

    void receive(ros::CallbackQueue& from) {
        while (!is_stopping()) from.callAvailable(ros::WallDuration(0.1));
    }

    void watch() {
        RosClient client(master), own(itself.uri);
        std::unique_lock hold(lock);
        while (!stop.wait_for(hold, kWatchPeriod, [this] { return stopping; })) {
            hold.unlock();
            if (look_for_master(client)) {
                subscribe_pending();
                follow_parameters(private_parameters(client, itself));
            }
            count_dropped(dropped_messages(own, itself));
            hold.lock();
        }
    }

    /// False while there is no master, or it is not told yet what this node does.
    bool look_for_master(RosClient& client) {
        const auto found = client.call("lookupNode", {itself.name, itself.name});
        if (!found) {
            if (std::exchange(is_there, false)) {
                say(
                    fmt::format("the master at {} does not answer; what is connected goes on, new "
                                "topics are found when it is back",
                                master));
            }
            return false;
        }
        // A known node with another address is one of the same name; then this one is to end.
        if (!found->is_ok) is_registered = false;
        const bool was_away = !is_there || !is_registered;
        if (!is_registered) is_registered = register_anew(client, itself);
        if (is_registered && was_away) {
            is_there = true;
            offer_services();
            say(fmt::format("the master at {} is back", master));
        }
        return is_registered;
    }

    /// Tells the master of all services.
    void offer_services() {
        const std::lock_guard change(changing);
        for (Service& service : services) {
            service.server.shutdown();
            service.server = node->advertiseService(service.options);
        }
    }

    void follow_parameters(std::map<std::string, std::string> now) {
        const std::lock_guard hold(lock);
        for (const std::string& name : watched) {
            const auto value = now.find(name);
            if (value == now.end()) continue;
            std::string& before = parameters[name];
            if (std::exchange(before, value->second) != value->second) news[name] = before;
        }
    }

    void count_dropped(const std::map<int, std::uint64_t>& now) {
        const std::lock_guard hold(lock);
        for (const auto& [connection, count] : now) dropped[connection] = count;
    }

    void subscribe_pending() {
        const std::lock_guard change(changing);
        std::vector<std::string> pending;
        {
            const std::lock_guard hold(lock);
            for (const auto& [topic, subscription] : subscriptions) {
                if (!subscription.subscriber) pending.push_back(topic);
            }
        }
        for (const std::string& topic : pending) connect(topic);
    }

    /// Needs the mutex `changing`.
    void connect(const std::string& topic) {
        ros::SubscribeOptions options;
        {
            const std::lock_guard hold(lock);
            if (subscriptions.at(topic).subscriber) return;
            options = subscriptions.at(topic).options;
        }
        const ros::Subscriber subscriber = node->subscribe(options);
        const std::lock_guard hold(lock);
        subscriptions.at(topic).subscriber = subscriber;
    }
};

Ros1Bus::Ros1Bus(const std::map<std::string, std::string>& remappings,
                 std::vector<std::string> watched, double wait)
    : engine_(std::make_unique<Engine>(remappings, std::move(watched), wait)) {}

Ros1Bus::~Ros1Bus() = default;

std::string Ros1Bus::description() const {
    return fmt::format("ROS 1, node {}, master at {}", engine_->itself.name, engine_->master);
}

void Ros1Bus::advertise(const io::Topic& topic, const Quality& quality) {
    const io::Definition* const definition = io::find_definition(topic.type);
    if (definition == nullptr) {
        throw Error(fmt::format("cannot publish {}: unknown type {}", topic.name, topic.type));
    }
    ros::AdvertiseOptions options(topic.name, queue_size(quality), definition->md5, topic.type,
                                  io::full_definition(topic.type, io::MessageEncoding::ros1));
    options.latch = quality.latched;
    options.callback_queue = &engine_->queue;
    ros::Publisher publisher;
    {
        const std::lock_guard hold(engine_->lock);
        publisher = std::exchange(engine_->publishers[topic.name], {});
    }
    publisher.shutdown();
    try {
        publisher = engine_->node->advertise(options);
    } catch (const ros::Exception& error) {
        throw Error(fmt::format("cannot publish {}: {}", topic.name, error.what()));
    }
    const std::lock_guard hold(engine_->lock);
    engine_->publishers[topic.name] = publisher;
}

bool Ros1Bus::is_wanted(const std::string& topic) const {
    ros::Publisher publisher;
    std::uint32_t own = 0;
    {
        const std::lock_guard hold(engine_->lock);
        const auto found = engine_->publishers.find(topic);
        if (found == engine_->publishers.end()) return false;
        publisher = found->second;
        own = engine_->subscriptions.contains(topic) ? 1 : 0;
    }
    return publisher.getNumSubscribers() > own;
}

bool Ros1Bus::publish(const std::string& topic, double, const Bytes& message) {
    ros::Publisher publisher;
    {
        const std::lock_guard hold(engine_->lock);
        const auto found = engine_->publishers.find(topic);
        if (found == engine_->publishers.end() || !found->second) return false;
        publisher = found->second;
    }
    publisher.publish(RawMessage{message});
    return true;  // what roscpp drops for a slow subscriber, it does not tell
}

std::vector<SeenTopic> Ros1Bus::seen() const {
    RosClient client(engine_->master);
    return topics_of_others(client, engine_->itself, ros::names::getRemappings());
}

void Ros1Bus::subscribe(const io::Topic& topic, const Quality& quality, Receive receive) {
    Engine& e = *engine_;
    const io::Definition* const definition = io::find_definition(topic.type);
    const Expected expected{topic, definition == nullptr ? "" : definition->md5, e.itself.name};
    ros::SubscribeOptions options(topic.name, queue_size(quality), "*", topic.type);
    options.helper = boost::make_shared<RawReceiver>(
        expected, std::move(receive), [&e](const std::string& text) { e.say(text); });
    options.callback_queue = &e.queue;
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    ros::Subscriber old;
    {
        const std::lock_guard hold(e.lock);
        Engine::Subscription& subscription = e.subscriptions[topic.name];
        old = std::exchange(subscription.subscriber, {});
        subscription.options = options;
    }
    old.shutdown();  // waits for its last call
    const std::lock_guard change(e.changing);
    try {
        e.connect(topic.name);
    } catch (const ros::Exception& error) {
        const std::lock_guard hold(e.lock);
        e.subscriptions.erase(topic.name);
        throw Error(fmt::format("cannot subscribe to {}: {}", topic.name, error.what()));
    }
}

void Ros1Bus::serve(const std::string& name, const ServiceType& type, Serve serve) {
    Engine& e = *engine_;
    const std::string datatype(type.name);
    ros::AdvertiseServiceOptions options;
    options.service = name;
    options.datatype = datatype;
    options.md5sum = std::string(type.md5);
    options.req_datatype = datatype + "Request";
    options.res_datatype = datatype + "Response";
    options.helper = boost::make_shared<RawService>(std::move(serve));
    options.callback_queue = &e.calls;
    const std::lock_guard change(e.changing);
    try {
        e.services.push_back({options, e.node->advertiseService(options)});
    } catch (const ros::Exception& error) {
        throw Error(fmt::format("cannot offer the service {}: {}", name, error.what()));
    }
}

void Ros1Bus::stop() {
    const std::lock_guard change(engine_->changing);
    for (Engine::Service& service : engine_->services) {
        service.server.shutdown();  // waits for its last call
    }
    engine_->services.clear();
    std::map<std::string, Engine::Subscription> ended;
    {
        const std::lock_guard hold(engine_->lock);
        ended.swap(engine_->subscriptions);
    }
    for (auto& [topic, subscription] : ended) {
        subscription.subscriber.shutdown();  // waits for its last call
    }
}

/// Messages that came faster than they were taken. What was lost before is not known: publishers
/// do not tell, and header.seq has gaps of its own, for instance in bags that were cut.
std::uint64_t Ros1Bus::lost() const {
    const std::lock_guard hold(engine_->lock);
    std::uint64_t lost = 0;
    for (const auto& [connection, count] : engine_->dropped) lost += count;
    return lost;
}

std::vector<std::string> Ros1Bus::pop_notices() {
    const std::lock_guard hold(engine_->lock);
    return std::exchange(engine_->notices, {});
}

std::vector<std::pair<std::string, std::string>> Ros1Bus::pop_parameters() {
    const std::lock_guard hold(engine_->lock);
    const auto news = std::exchange(engine_->news, {});
    return {news.begin(), news.end()};
}

}  // namespace dynamic_filter::live
