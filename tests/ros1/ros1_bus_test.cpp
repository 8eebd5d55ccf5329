// SPDX-License-Identifier: MIT
#include "ros1/ros1_bus.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <ros/connection_manager.h>
#include <ros/xmlrpc_manager.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <mutex>
#include <random>
#include <thread>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "ros1/ros_client.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::live {
namespace ros1_bus_test {

using test::ChildProcess;
using test::slurp;
using test::TemporaryFolder;
using XmlRpc::XmlRpcValue;

bool eventually(const std::function<bool()>& what, double seconds = 20.0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
        if (what()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return what();
}

struct Inbox {
    std::mutex lock;
    std::vector<Bytes> messages;
    Bus::Receive receive() {
        return [this](const io::Topic&, const Bytes& message) {
            const std::lock_guard hold(lock);
            messages.push_back(message);
        };
    }
    std::vector<Bytes> all() {
        const std::lock_guard hold(lock);
        return messages;
    }
    std::size_t size() { return all().size(); }
};

Bytes random_bytes(std::size_t size) {
    auto bytes = std::make_shared<std::vector<std::byte>>(size);
    std::mt19937 random(static_cast<unsigned>(size));
    for (std::byte& b : *bytes) b = static_cast<std::byte>(random());
    return bytes;
}

Bytes cloud_with_labels() {
    io::Cloud cloud;
    for (const char* name : {"x", "y", "z"}) io::add_field(cloud, name, io::FieldType::f32);
    io::add_field(cloud, "label", io::FieldType::u32);
    for (const float x : {1.5F, -2.25F}) {
        const std::array<float, 3> point{x, 2.0F, 3.0F};
        const std::uint32_t label = 251;
        const auto* const begin = reinterpret_cast<const std::byte*>(point.data());
        cloud.data.insert(cloud.data.end(), begin, begin + sizeof point);
        const auto* const value = reinterpret_cast<const std::byte*>(&label);
        cloud.data.insert(cloud.data.end(), value, value + sizeof label);
    }
    return std::make_shared<const std::vector<std::byte>>(
        io::cloud_message(cloud, 1700000000.25, "map", io::MessageEncoding::ros1));
}

int bound_socket(std::uint16_t port, const std::function<int(int, const sockaddr*)>& use) {
    const int socket_number = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(use(socket_number, reinterpret_cast<const sockaddr*>(&address)), 0);
    return socket_number;
}

std::uint16_t free_port() {
    const int probe =
        bound_socket(0, [](int s, const sockaddr* to) { return bind(s, to, sizeof(sockaddr_in)); });
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
    close(probe);
    return ntohs(address.sin_port);
}

void send_garbage(std::uint16_t port, const std::string& garbage) {
    const int s = bound_socket(
        port, [](int n, const sockaddr* to) { return connect(n, to, sizeof(sockaddr_in)); });
    EXPECT_EQ(send(s, garbage.data(), garbage.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(garbage.size()));
    close(s);
}

const io::Topic& cloud_topic(const std::string& name) {
    static std::map<std::string, io::Topic> topics;
    return topics[name] = {name, "sensor_msgs/PointCloud2", io::MessageEncoding::ros1};
}

/// One master and one bus for all tests, because a process can be one node only. The time is
/// simulated, and nobody publishes it.
struct Ros1 : testing::Test {
    static inline std::unique_ptr<TemporaryFolder> folder;
    static inline std::uint16_t port = 0;
    static inline std::unique_ptr<ChildProcess> master, peer;
    static inline std::unique_ptr<Ros1Bus> bus;
    static inline std::vector<std::pair<std::string, std::string>> first_parameters;

    static std::string uri() { return "http://127.0.0.1:" + std::to_string(port); }
    static std::string log() { return (folder->path() / "log").string(); }
    static std::string peer_output(const std::string& name) {
        return (folder->path() / (name + ".out")).string();
    }

    static bool start_master() {
        master = std::make_unique<ChildProcess>(
            std::vector<std::string>{"/usr/bin/rosmaster", "--core", "-p", std::to_string(port)},
            log());
        return eventually([] { return RosClient(uri()).call("getPid", {"/test"}).has_value(); });
    }
    static std::unique_ptr<ChildProcess> start_peer(const std::string& name) {
        return std::make_unique<ChildProcess>(
            std::vector<std::string>{"/usr/bin/python3", ROS1_PEER, name}, peer_output(name));
    }
    static void set_parameter(const std::string& name, const XmlRpcValue& value) {
        RosClient(uri()).call("setParam", {"/test", name, value});
    }
    static bool notices_contain(const std::string& text) {
        static std::vector<std::string> said;
        for (const std::string& notice : bus->pop_notices()) said.push_back(notice);
        return std::any_of(said.begin(), said.end(), [&](const std::string& notice) {
            return notice.find(text) != std::string::npos;
        });
    }

    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        port = free_port();
        unsetenv("ROS_HOSTNAME");
        setenv("ROS_IP", "127.0.0.1", 1);
        setenv("ROS_MASTER_URI", uri().c_str(), 1);
        setenv("ROS_HOME", folder->path().c_str(), 1);
        setenv("ROS_LOG_DIR", folder->path().c_str(), 1);
        EXPECT_THROW(Ros1Bus({}, {}, 0.0), Error) << "there is no master yet";
        EXPECT_THROW(Ros1Bus({{"__master", "nowhere"}}, {}, 0.0), ConfigError);
        ASSERT_TRUE(start_master()) << slurp(log());
        set_parameter("/use_sim_time", true);
        set_parameter("/filter/map/rate", 0.5);
        set_parameter("/filter/map/on", false);
        set_parameter("/filter/bus/topic", "/points");
        XmlRpcValue list;
        list[0] = "a", list[1] = 2;
        set_parameter("/filter/bus/list", list);
        peer = start_peer("peer");
        bus = std::make_unique<Ros1Bus>(
            std::map<std::string, std::string>{{"__name", "filter"}, {"points", "/peer/points"}},
            std::vector<std::string>{"map.rate"}, 10.0);
        first_parameters = bus->pop_parameters();
        bus->advertise(cloud_topic("/filter/raw"), {.depth = 10});
        bus->advertise(cloud_topic("/filter/cloud"), {.latched = true});
    }
    static void TearDownTestSuite() {
        master->send(SIGSTOP);
        alarm(60);  // ends the test if the bus waits for a master that hangs
        bus.reset();
        alarm(0);
        peer.reset();
        master.reset();
        folder.reset();
    }
};

TEST_F(Ros1, BytesOfAllSizesComeBackAsTheyWent) {
    Inbox inbox;
    bus->subscribe(cloud_topic("/peer/raw"), {.depth = 10}, inbox.receive());
    ASSERT_TRUE(eventually([&] { return bus->is_wanted("/filter/raw"); }));
    // The echo is there once a message has come back.
    ASSERT_TRUE(eventually([&] {
        bus->publish("/filter/raw", 0.0, random_bytes(3));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return inbox.size() > 0;
    }));
    std::vector<Bytes> sent;
    for (const std::size_t size : {0UL, 1UL, 100UL, 65537UL, 4000003UL}) {
        sent.push_back(random_bytes(size));
        EXPECT_TRUE(bus->publish("/filter/raw", 0.0, sent.back()));
        ASSERT_TRUE(eventually([&] { return *inbox.all().back() == *sent.back(); })) << size;
    }
    EXPECT_EQ(bus->lost(), 0U);
    bus->subscribe(cloud_topic("/peer/raw"), {}, [](const auto&, const auto&) {});
}

TEST_F(Ros1, ALateSubscriberDecodesTheLatchedCloud) {
    ASSERT_TRUE(bus->publish("/filter/cloud", 0.0, cloud_with_labels()));
    const auto late = start_peer("late");
    const std::string expected = R"({"seq": 0, "stamp": 1700000000250000000, "frame": "map", )"
                                 R"("points": [[1.5, 2.0, 3.0, 251], [-2.25, 2.0, 3.0, 251]]})";
    EXPECT_TRUE(eventually([&] {
        return slurp(peer_output("late")).find(expected) != std::string::npos;
    })) << slurp(peer_output("late"));
}

TEST_F(Ros1, OthersAreSeenAndOwnTopicsAreNot) {
    const auto count = [](const std::string& name) -> std::size_t {
        for (const SeenTopic& topic : bus->seen()) {
            if (topic.name == name && topic.type == "sensor_msgs/PointCloud2") {
                return topic.publishers;
            }
        }
        return 0;
    };
    // By its name here: the node was started with points:=/peer/points.
    EXPECT_TRUE(eventually([&] { return count("/points") >= 1; }));
    EXPECT_EQ(count("/peer/points"), 0U);
    EXPECT_EQ(count("/filter/raw"), 0U);
    EXPECT_NE(bus->description().find("node /filter, master at " + uri()), std::string::npos);
}

TEST_F(Ros1, RemappedTopicsAreReceivedUnderTheirNameHere) {
    std::atomic<bool> came = false;
    bus->subscribe(cloud_topic("/points"), {}, [&](const io::Topic& topic, const Bytes& message) {
        came = topic.name == "/points" && message->size() > 100;
    });
    EXPECT_TRUE(eventually([&] { return came.load(); }));
    bus->subscribe(cloud_topic("/points"), {}, [](const auto&, const auto&) {});
}

TEST_F(Ros1, OwnMessagesDoNotComeBack) {
    Inbox inbox;
    bus->advertise(cloud_topic("/filter/own"), {});
    bus->subscribe(cloud_topic("/filter/own"), {}, inbox.receive());
    EXPECT_FALSE(bus->is_wanted("/filter/own"));
    bus->publish("/filter/own", 0.0, random_bytes(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(inbox.size(), 0U);
    bus->subscribe(cloud_topic("/filter/own"), {}, [](const auto&, const auto&) {});
}

TEST_F(Ros1, ParametersComeAtTheStartAndWatchedOnesWhenTheyChange) {
    const std::vector<std::pair<std::string, std::string>> expected{{"bus.list", "[\"a\", 2]"},
                                                                    {"bus.topic", "/points"},
                                                                    {"map.on", "false"},
                                                                    {"map.rate", "0.5"}};
    EXPECT_EQ(first_parameters, expected);
    set_parameter("/filter/bus/topic", "/other");
    set_parameter("/filter/map/rate", 2);
    std::vector<std::pair<std::string, std::string>> changed;
    ASSERT_TRUE(eventually([&] { return !(changed = bus->pop_parameters()).empty(); }));
    EXPECT_EQ(changed, decltype(changed)({{"map.rate", "2"}}));
    EXPECT_TRUE(bus->pop_parameters().empty());
}

TEST_F(Ros1, ReceivesWhatRosbagPlays) {
    const std::string file = (folder->path() / "recording.bag").string();
    std::vector<Bytes> written;
    const auto writer = io::BagWriter::create(file);
    for (int i = 0; i < 5; ++i) {
        written.push_back(std::make_shared<const std::vector<std::byte>>(io::transform_message(
            "map", "lidar", Pose(Eigen::Translation3d(i, 0, 0)), 10.0 + i, writer->encoding())));
        writer->write({"/tf", "tf2_msgs/TFMessage", writer->encoding()}, 10'000'000'000 + i,
                      *written.back());
    }
    writer->commit();
    Inbox inbox;
    bus->subscribe({"/tf", "tf2_msgs/TFMessage", io::MessageEncoding::ros1}, {.depth = 10},
                   inbox.receive());
    const ChildProcess player({"/usr/lib/rosbag/play", "--quiet", "--wait-for-subscribers", file},
                              log());
    EXPECT_TRUE(eventually([&] { return inbox.size() == written.size(); }))
        << inbox.size() << slurp(log());
    const auto received = inbox.all();
    for (std::size_t i = 0; i < received.size(); ++i) EXPECT_EQ(*received[i], *written[i]) << i;
    bus->subscribe({"/tf", "tf2_msgs/TFMessage", io::MessageEncoding::ros1}, {},
                   [](const auto&, const auto&) {});
}

TEST_F(Ros1, OtherTypesOfTheSameNameAreNoticed) {
    Inbox inbox;
    bus->subscribe(cloud_topic("/peer/wrong"), {}, inbox.receive());
    EXPECT_TRUE(eventually([] {
        return notices_contain(
            "/peer/wrong: the messages of /peer are left out: they are "
            "sensor_msgs/PointCloud2 with MD5 sum 0123456789abcdef");
    }));
    EXPECT_EQ(inbox.size(), 0U);
    bus->subscribe(cloud_topic("/peer/wrong"), {}, [](const auto&, const auto&) {});
}

TEST_F(Ros1, RefusesUnknownTypesAndWrongNames) {
    EXPECT_THROW(bus->advertise({"/a", "a/B", io::MessageEncoding::ros1}, {}), Error);
    EXPECT_THROW(bus->advertise(cloud_topic("/a b"), {}), Error);
    EXPECT_THROW(bus->subscribe(cloud_topic("/a b"), {}, {}), Error);
    EXPECT_FALSE(bus->publish("/never/advertised", 0.0, random_bytes(1)));
    EXPECT_THROW(Ros1Bus({}, {}, 1.0), Error) << "a second node in this process";
}

TEST_F(Ros1, ASlowReceiverLosesMessagesThatAreCounted) {
    const auto go = std::make_shared<std::atomic<bool>>(false);
    bus->subscribe(cloud_topic("/points"), {.depth = 1}, [go](const io::Topic&, const Bytes&) {
        eventually([&] { return go->load(); });
    });
    EXPECT_TRUE(eventually([] { return bus->lost() > 3; }));
    *go = true;
    bus->subscribe(cloud_topic("/points"), {}, [](const auto&, const auto&) {});
    EXPECT_GT(bus->lost(), 3U);
}

TEST_F(Ros1, GarbageOnThePortsHarmsNothing) {
    const auto own_ports = {
        static_cast<std::uint16_t>(ros::ConnectionManager::instance()->getTCPPort()),
        static_cast<std::uint16_t>(ros::XMLRPCManager::instance()->getServerPort())};
    const std::string valid_length("\x08\0\0\0\x04\0\0\0a=bc", 12);
    for (const std::uint16_t own : own_ports) {
        send_garbage(own, "GET / HTTP/1.1\r\n\r\n");
        send_garbage(own, std::string(1000, '\xff'));
        send_garbage(own, std::string(1000, '\0'));
        send_garbage(own, valid_length);
    }
    Inbox inbox;
    bus->subscribe(cloud_topic("/points"), {}, inbox.receive());
    EXPECT_TRUE(eventually([&] { return inbox.size() > 0; }));
    bus->subscribe(cloud_topic("/points"), {}, [](const auto&, const auto&) {});
}

TEST_F(Ros1, TrafficIsBackAfterTheMasterWasAway) {
    Inbox echoed, inbox;
    bus->subscribe(cloud_topic("/peer/raw"), {}, echoed.receive());
    ASSERT_TRUE(eventually([&] {
        bus->publish("/filter/raw", 0.0, random_bytes(100));
        return echoed.size() > 0;
    }));
    master.reset();
    ASSERT_TRUE(eventually([] { return notices_contain("does not answer"); }));
    EXPECT_TRUE(bus->seen().empty());
    const std::size_t before = echoed.size();
    EXPECT_TRUE(eventually([&] {
        bus->publish("/filter/raw", 0.0, random_bytes(100));
        return echoed.size() > before;
    })) << "what is connected goes on";
    bus->subscribe(cloud_topic("/points"), {}, inbox.receive());
    EXPECT_TRUE(bus->publish("/filter/cloud", 0.0, cloud_with_labels()));
    peer.reset();  // to be sure that nothing comes by old connections
    ASSERT_TRUE(start_master());
    ASSERT_TRUE(eventually([] { return notices_contain("is back"); }));
    peer = start_peer("another");
    EXPECT_TRUE(eventually([&] { return inbox.size() > 0; })) << "subscribed meanwhile";
    EXPECT_TRUE(eventually([&] {
        return slurp(peer_output("another")).find("251") != std::string::npos;
    })) << "published before";
    for (const char* topic : {"/points", "/peer/raw"}) {
        bus->subscribe(cloud_topic(topic), {}, [](const auto&, const auto&) {});
    }
}

volatile std::sig_atomic_t asked_to_end = 0;

TEST_F(Ros1, AShutdownByRosIsASignal) {
    std::signal(SIGTERM, [](int) { asked_to_end = 1; });
    RosClient(ros::XMLRPCManager::instance()->getServerURI())
        .call("shutdown", {"/test", "new node registered with same name"});
    EXPECT_TRUE(eventually([] { return asked_to_end != 0; }));
    std::signal(SIGTERM, SIG_DFL);
    EXPECT_TRUE(notices_contain("ROS asks this node to end: new node registered"));
    EXPECT_TRUE(bus->publish("/filter/cloud", 0.0, cloud_with_labels())) << "it may still publish";
}

}  // namespace ros1_bus_test
}  // namespace dynamic_filter::live
