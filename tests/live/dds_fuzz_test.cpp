// SPDX-License-Identifier: MIT
// Faulty messages from a peer, and faulty packets: nothing crashes, no more memory is asked for
// than the message has, and what is right still arrives.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "dynamic_filter/bag.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/messages.hpp"
#include "live/dds_bus.hpp"
#include "live/dds_configuration.hpp"
#include "live/dds_support.hpp"
#include "live/largest_allocation.hpp"
#include "live/peer_process.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::live {
namespace dds_fuzz_test {

using Message = std::vector<std::byte>;
constexpr auto kCdr = io::MessageEncoding::cdr;
constexpr std::size_t kHead = 4;  // [bytes] of the CDR header
/// The kinds of CDR that exist; Cyclone DDS drops packets with any other.
constexpr std::byte kKinds[] = {std::byte{0}, std::byte{1}, std::byte{2}, std::byte{3},
                                std::byte{6}, std::byte{7}, std::byte{8}, std::byte{9}};

/// Changes a message or packet in one of the ways that faults and attacks do. The first `kept`
/// bytes stay.
class Mutator {
public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
    }
    Message mutate(Message bytes, std::size_t kept) {
        for (std::size_t changes = 1 + below(3); changes > 0; --changes) change(bytes, kept);
        return bytes;
    }

private:
    void change(Message& bytes, std::size_t kept) {
        if (bytes.size() <= kept + sizeof(double)) return;
        const std::size_t at = kept + below(bytes.size() - kept - sizeof(double) + 1);
        const std::size_t aligned = at / 4 * 4;
        switch (below(7)) {
            case 0:
                bytes.resize(at);
                break;
            case 1:
                bytes[at] = static_cast<std::byte>(below(256));
                break;
            case 2:
                put(bytes, aligned, kSizes[below(std::size(kSizes))]);
                break;
            case 3:
                put(bytes, aligned, std::numeric_limits<double>::quiet_NaN());
                break;
            case 4:
                put(bytes, aligned, std::numeric_limits<float>::infinity());
                break;
            case 5:
                bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), below(9),
                             std::byte{1});
                break;
            default:
                std::swap(bytes[at], bytes[kept + below(bytes.size() - kept)]);
        }
    }
    template <class T>
    static void put(Message& bytes, std::size_t at, T value) {
        if (at + sizeof value <= bytes.size()) std::memcpy(bytes.data() + at, &value, sizeof value);
    }

    static constexpr std::uint32_t kSizes[] = {0,          1,          0x7fffffff, 0x80000000,
                                               0xffffffff, 0xfffffffe, 0x10000000, 65536};
    std::mt19937 random_;
};

/// Reads a message as the filter does; faults are those of the message.
bool is_readable(const io::Topic& topic, const Message& bytes) {
    try {
        const io::Message message{topic, 0, {}, bytes};
        if (io::kind_of(topic.type) == io::MessageKind::cloud) {
            const io::Cloud cloud = io::read_cloud_message(bytes, topic).cloud;
            EXPECT_EQ(cloud.data.size(), cloud.size() * cloud.point_bytes);
            (void)io::positions(cloud);
        } else if (io::kind_of(topic.type) == io::MessageKind::transforms) {
            (void)io::read_transforms(message);
        } else {
            (void)io::read_pose_message(message);
        }
        return true;
    } catch (const io::Malformed&) {
        return false;
    }
}

Message some_cloud() {
    io::Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) io::add_field(cloud, axis, io::FieldType::f32);
    io::add_field(cloud, "ring", io::FieldType::u16);
    cloud.data.resize(cloud.point_bytes * 20);
    return io::cloud_message(cloud, 1.0, "lidar", kCdr);
}

/// What a topic got.
struct Readings {
    std::mutex lock;
    std::size_t messages = 0, readable = 0;
    double most_memory = 0.0;  // the largest allocation per byte of the message
};

struct DdsFuzz : testing::Test {
    ReservedDomain domain;
    DdsBus bus{{.domain = domain.number(), .network = "localhost"}};

    std::shared_ptr<Readings> read_all(const io::Topic& topic, bool reliable) {
        auto readings = std::make_shared<Readings>();
        bus.subscribe(topic, {.reliable = reliable, .latched = reliable, .depth = 100000},
                      [readings](const io::Topic& from, const Bytes& message) {
                          (void)pop_largest_allocation();
                          const bool readable = is_readable(from, *message);
                          const double memory = static_cast<double>(pop_largest_allocation()) /
                                                static_cast<double>(message->size() + 100);
                          const std::lock_guard hold(readings->lock);
                          ++readings->messages;
                          readings->readable += readable ? 1 : 0;
                          readings->most_memory = std::max(readings->most_memory, memory);
                      });
        return readings;
    }
    [[nodiscard]] std::unique_ptr<PeerProcess> relay(const io::Topic& topic, bool reliable) const {
        return std::make_unique<PeerProcess>(std::vector<std::string>{
            FASTDDS_PEER, "relay", "domain=" + std::to_string(domain.number()), "depth=0",
            reliable ? "latched=1" : "reliable=0", "topic=" + dds_topic_name(topic.name),
            "type=" + dds_type_name(topic.type)});
    }
    static void send(PeerProcess& peer, const Message& message) {
        const auto size = static_cast<std::uint32_t>(message.size());
        peer.write(std::as_bytes(std::span(&size, 1)));
        peer.write(message);
    }

    void expect_survival(const io::Topic& topic, const Message& good) {
        constexpr std::size_t kCount = 1500;
        const auto readings = read_all(topic, true);
        const auto peer = relay(topic, true);
        Mutator mutator(42);
        for (std::size_t i = 0; i < kCount; ++i) {
            Message bad = mutator.mutate(good, kHead);
            bad[1] = kKinds[i % 3 == 0 ? mutator.below(std::size(kKinds)) : 1];
            send(*peer, bad);
        }
        send(*peer, good);
        ASSERT_TRUE(eventually([&] {
            const std::lock_guard hold(readings->lock);
            return readings->messages > kCount;
        })) << readings->messages;
        const std::lock_guard hold(readings->lock);
        EXPECT_GT(readings->readable, kCount / 100) << "some faults do not matter";
        EXPECT_LT(readings->readable, kCount) << "others do";
        EXPECT_LT(readings->most_memory, 32.0);
    }
};

TEST_F(DdsFuzz, FaultyClouds) {
    expect_survival({"/points", "sensor_msgs/PointCloud2", kCdr}, some_cloud());
}

TEST_F(DdsFuzz, FaultyTransforms) {
    expect_survival({"/tf", "tf2_msgs/TFMessage", kCdr},
                    io::transform_message("map", "odom", Pose::Identity(), 1.0, kCdr));
}

TEST_F(DdsFuzz, FaultyOdometry) {
    expect_survival({"/odom", "nav_msgs/Odometry", kCdr},
                    io::odometry_message("odom", "base", Pose::Identity(), 1.0, kCdr));
}

TEST_F(DdsFuzz, MessagesWithoutHeader) {
    const io::Topic topic{"/tf", "tf2_msgs/TFMessage", kCdr};
    const Message good = io::transform_message("map", "odom", Pose::Identity(), 1.0, kCdr);
    const auto readings = read_all(topic, false);
    const auto peer = relay(topic, false);
    ASSERT_TRUE(eventually([&] {
        for (std::size_t size = 0; size < kHead; ++size) send(*peer, Message(size));
        Message bad = good;
        for (std::size_t kind = 0; kind < 256; kind += 5) {
            bad[1] = static_cast<std::byte>(kind);
            send(*peer, bad);
        }
        send(*peer, good);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        const std::lock_guard hold(readings->lock);
        return readings->readable > 10;
    }));
}

/// The UDP packets of a capture of Cyclone DDS.
std::vector<Message> packets_in(const std::filesystem::path& capture) {
    constexpr std::size_t kFileHead = 24, kPacketHead = 16, kIpAndUdpHead = 28;
    std::ifstream in(capture, std::ios::binary);
    in.ignore(kFileHead);
    std::vector<Message> packets;
    std::uint32_t head[kPacketHead / sizeof(std::uint32_t)];
    while (in.read(reinterpret_cast<char*>(head), sizeof head)) {
        Message packet(head[2]);
        in.read(reinterpret_cast<char*>(packet.data()),
                static_cast<std::streamsize>(packet.size()));
        if (!in || packet.size() <= kIpAndUdpHead) continue;
        packet.erase(packet.begin(), packet.begin() + kIpAndUdpHead);
        packets.push_back(std::move(packet));
    }
    return packets;
}

/// Sends packets to a port of this machine.
class Sender {
public:
    explicit Sender(int port) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        (void)connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    }
    Sender(const Sender&) = delete;
    Sender& operator=(const Sender&) = delete;
    ~Sender() { close(socket_); }
    void send(const Message& packet) const {
        (void)::send(socket_, packet.data(), packet.size(), 0);
    }

private:
    int socket_;
};

/// What two buses in two processes would say to each other, by a peer that comes and goes.
std::vector<Message> captured_packets(int domain) {
    const test::TemporaryFolder folder;
    const std::string start = "</Internal>";
    std::string configuration = dds_configuration("localhost", domain);
    configuration.insert(configuration.find(start) + start.size(),
                         "<Tracing><PacketCaptureFile>" + (folder / "packets").string() +
                             "</PacketCaptureFile></Tracing>");
    setenv("CYCLONEDDS_URI", configuration.c_str(), 1);
    {
        const io::Topic topic{"/points", "sensor_msgs/PointCloud2", kCdr};
        DdsBus bus({.domain = domain, .network = {}});
        Inbox inbox;
        bus.subscribe(topic, {}, inbox.receive());
        bus.advertise({"/out", topic.type, kCdr}, {});
        const std::string number = "domain=" + std::to_string(domain);
        PeerProcess publisher({FASTDDS_PEER, "publish", number});
        PeerProcess subscriber({FASTDDS_PEER, "subscribe", number, "topic=rt/out"});
        EXPECT_TRUE(eventually([&] {
            publisher.write("1 1000 100 200000\n");
            bus.publish("/out", 0.0, std::make_shared<const Message>(200000, std::byte{1}));
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            return inbox.size() > 3 && subscriber.said("got").size() > 3;
        }));
    }
    unsetenv("CYCLONEDDS_URI");
    return packets_in(folder / "packets");
}

TEST(DdsPackets, FaultyPacketsDoNotStopReception) {
    const ReservedDomain domain;
    const std::vector<Message> packets = captured_packets(domain.number());
    ASSERT_GT(packets.size(), 50U);
    // Only by loopback, because faulty addresses must not be answered.
    DdsBus bus({.domain = domain.number(), .network = "lo"});
    Inbox inbox;
    bus.subscribe({"/points", "sensor_msgs/PointCloud2", kCdr}, {}, inbox.receive());
    const int first = 7400 + 250 * domain.number() + 10;
    const Sender discovery(first), data(first + 1);
    Mutator mutator(1);
    constexpr std::size_t kProtocol = 4, kHead20 = 20, kCount = 20000;
    for (std::size_t i = 0; i < kCount; ++i) {
        Message packet = packets[mutator.below(packets.size())];
        if (i % 10 == 0) {
            packet.resize(kHead20 + mutator.below(1000));
            for (std::size_t at = kProtocol; at < packet.size(); ++at) {
                packet[at] = static_cast<std::byte>(mutator.below(256));
            }
        }
        packet = mutator.mutate(std::move(packet), i % 3 == 0 ? kProtocol : kHead20);
        (i % 2 == 0 ? discovery : data).send(packet);
        if (i % 100 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    PeerProcess peer({FASTDDS_PEER, "publish", "domain=" + std::to_string(domain.number())});
    EXPECT_TRUE(eventually([&] {
        peer.write("1 1000 100000\n");
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        return inbox.size() > 0;
    }));
}

}  // namespace dds_fuzz_test
}  // namespace dynamic_filter::live
