// SPDX-License-Identifier: MIT
#include "live/player.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/recording.hpp"
#include "formats/messages/message_writer.hpp"
#include "formats/messages/messages.hpp"

namespace dynamic_filter::live {

using Options = PlayerOptions;

namespace {

using Clock = std::chrono::steady_clock;

struct Played {
    std::int64_t stamp_ns = 0;
    std::vector<std::byte> cloud, transforms;
};

std::int64_t stamp_of(std::span<const std::byte> message, std::size_t at) {
    std::array<std::uint32_t, 2> time{};
    std::memcpy(time.data(), message.data() + at, sizeof time);
    return std::int64_t{time[0]} * 1'000'000'000 + time[1];
}

void put_stamp(std::vector<std::byte>& message, std::size_t at, std::int64_t stamp_ns) {
    const std::array<std::uint32_t, 2> time{static_cast<std::uint32_t>(stamp_ns / 1'000'000'000),
                                            static_cast<std::uint32_t>(stamp_ns % 1'000'000'000)};
    std::memcpy(message.data() + at, time.data(), sizeof time);
}

constexpr double kBeforeJump = 10000.0;  // [s] so that no stamp becomes negative
constexpr std::size_t kCloudStamp = 4, kTransformStamp = 8;  // [bytes]

/// The bag must hold one transform of /tf for each scan, as `convert` writes it.
std::vector<Played> read(const Options& o) {
    std::map<std::int64_t, Played> scans;
    io::Bag(o.bag).for_each([&](const io::Message& message) {
        if (message.topic.name == o.topic) {
            const std::int64_t stamp = stamp_of(message.data, kCloudStamp);
            scans[stamp].cloud.assign(message.data.begin(), message.data.end());
        } else if (message.topic.name == "/tf") {
            const std::int64_t stamp = stamp_of(message.data, kTransformStamp);
            scans[stamp].transforms.assign(message.data.begin(), message.data.end());
        }
    });
    std::vector<Played> list;
    for (auto& [stamp, played] : scans) {
        if (played.cloud.empty()) continue;  // the pose of another sensor
        played.stamp_ns = stamp;
        list.push_back(std::move(played));
    }
    return list;
}

struct Heard {
    std::mutex lock;
    std::map<std::int64_t, Clock::time_point> sent;
    std::vector<double> latencies;  // [ms]
    std::size_t labels = 0, unknown_stamps = 0, dynamic = 0;
    std::map<std::string, std::size_t> others;
    std::map<std::int64_t, Labels> verdicts;  // only for --check
    std::string saved;                        // the answer to --save
};

void count_labels(Heard& heard, bool keep, const io::Topic& topic, const Bytes& message) {
    const auto now = Clock::now();
    const io::CloudMessage cloud = io::read_cloud_message(*message, topic);
    const std::lock_guard hold(heard.lock);
    const auto sent = heard.sent.find(cloud.header.stamp_ns);
    if (sent == heard.sent.end()) {
        ++heard.unknown_stamps;
        return;
    }
    heard.latencies.push_back(
        std::chrono::duration<double, std::milli>(now - sent->second).count());
    heard.sent.erase(sent);
    ++heard.labels;
    Labels labels;
    const io::Field* const field = cloud.cloud.find("label");
    if (field == nullptr) return;  // of a relay
    for (const double value : io::values(cloud.cloud, *field)) {
        labels.push_back(static_cast<Label>(static_cast<int>(value)));
        heard.dynamic += labels.back() == Label::dynamic ? 1 : 0;
    }
    if (keep) heard.verdicts[cloud.header.stamp_ns] = std::move(labels);
}

/// Number of points whose instant label is not that of the library on the same recording.
std::size_t differing_labels(const Options& o, const Heard& heard) {
    io::OpenOptions options;
    options.topic = o.topic;
    options.pose_topic = "/tf";
    const io::Recording recording = io::open_recording(o.bag, options);
    DynamicFilter filter{Config{}};
    std::size_t differing = 0;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        io::FullScan full = recording.read(i);
        const auto own = filter.push({std::move(full.points), full.T_world_sensor, full.stamp, i});
        const auto stamp = io::to_nanoseconds(full.stamp);
        const auto heard_at =
            std::find_if(heard.verdicts.begin(), heard.verdicts.end(),
                         [&](const auto& v) { return std::abs(v.first - stamp) < 1000; });
        const Labels& labels = own.labels;
        if (heard_at == heard.verdicts.end() || heard_at->second.size() != labels.size()) {
            differing += labels.size();
            continue;
        }
        for (std::size_t k = 0; k < labels.size(); ++k) {
            differing += labels[k] == heard_at->second[k] ? 0 : 1;
        }
    }
    return differing;
}

std::int64_t in_ns(double seconds) { return static_cast<std::int64_t>(1e9 * seconds); }

bool eventually(const std::function<bool()>& what, double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!what()) {
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

double at_share(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

int play(Bus& bus, const Options& o) {
    std::vector<Played> scans = read(o);
    const std::int64_t step = (scans.back().stamp_ns - scans.front().stamp_ns) /
                              static_cast<std::int64_t>(scans.size() - 1);
    Heard heard;
    const auto encoding = bus.encoding();
    const bool relays = !o.answer.empty();
    const Quality reliable{.reliable = true, .latched = false, .depth = 10};
    bus.subscribe({relays ? o.answer : o.prefix + "/labels", "sensor_msgs/PointCloud2", encoding},
                  reliable, [&](const io::Topic& topic, const Bytes& message) {
                      count_labels(heard, o.check, topic, message);
                  });
    if (o.all) {
        const auto count = [&](const io::Topic& topic, const Bytes&) {
            const std::lock_guard hold(heard.lock);
            ++heard.others[topic.name];
        };
        for (const char* name : {"/static", "/dynamic", "/corrections", "/map"}) {
            bus.subscribe({o.prefix + name, "sensor_msgs/PointCloud2", encoding}, reliable, count);
        }
        bus.subscribe({o.prefix + "/removed", "visualization_msgs/MarkerArray", encoding}, reliable,
                      count);
        bus.subscribe({o.prefix + "/path", "nav_msgs/Path", encoding}, reliable, count);
        bus.subscribe({"/diagnostics", "diagnostic_msgs/DiagnosticArray", encoding}, reliable,
                      count);
    }
    if (o.pause) bus.advertise({o.prefix + "/pause", "std_msgs/Bool", encoding}, reliable);
    if (o.reset) bus.advertise({o.prefix + "/reset", "std_msgs/Empty", encoding}, reliable);
    if (o.save) {
        bus.advertise({o.prefix + "/save_map_as", "std_msgs/String", encoding}, reliable);
        bus.advertise({o.prefix + "/save_map", "std_msgs/Empty", encoding}, reliable);
        bus.subscribe({o.prefix + "/saved_map", "std_msgs/String", encoding}, reliable,
                      [&](const io::Topic&, const Bytes& message) {
                          const std::size_t head = encoding == io::MessageEncoding::cdr ? 4 : 0;
                          std::uint32_t length = 0;
                          std::memcpy(&length, message->data() + head, sizeof length);
                          const std::lock_guard hold(heard.lock);
                          heard.saved.assign(
                              reinterpret_cast<const char*>(message->data() + head + 4),
                              length - (head == 0 ? 0 : 1));
                      });
    }
    bus.advertise({o.topic, "sensor_msgs/PointCloud2", encoding}, reliable);
    bus.advertise({"/tf", "tf2_msgs/TFMessage", encoding}, {true, false, 100});
    const bool met = eventually(
        [&] { return bus.is_wanted(o.topic) && (relays || bus.is_wanted("/tf")); }, o.wait);
    if (!met) {
        fmt::print(stderr, "live_player: nobody subscribed to {} and /tf\n", o.topic);
        return 1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the other direction, too
    const auto start = Clock::now();
    std::size_t sent = 0, refused = 0;
    for (int pass = 0; pass < o.passes; ++pass) {
        for (std::size_t k = 0; k < scans.size(); ++k, ++sent) {
            Played& scan = scans[pass % 2 == 0 ? k : scans.size() - 1 - k];
            std::int64_t stamp_ns =
                pass == 0 ? scan.stamp_ns
                          : scans[0].stamp_ns + step * static_cast<std::int64_t>(sent);
            if (o.jump != 0.0) stamp_ns += in_ns(kBeforeJump + (2 * k > scans.size() ? o.jump : 0));
            auto cloud = scan.cloud, transforms = scan.transforms;
            put_stamp(cloud, kCloudStamp, stamp_ns);
            put_stamp(transforms, kTransformStamp, stamp_ns);
            std::this_thread::sleep_until(
                start + std::chrono::nanoseconds(static_cast<std::int64_t>(
                            static_cast<double>(step) * static_cast<double>(sent) / o.speed)));
            const auto share = [](std::vector<std::byte>& bytes) {
                return std::make_shared<const std::vector<std::byte>>(std::move(bytes));
            };
            const Bytes poses = share(transforms), points = share(cloud);
            {
                const std::lock_guard hold(heard.lock);
                heard.sent[stamp_ns] = Clock::now();
            }
            const auto ask = [&](const char* what, const auto& fill) {
                io::MessageWriter out(encoding);
                fill(out);
                auto message = out.moved_bytes();
                bus.publish(o.prefix + what, 0.0, share(message));
            };
            // In CDR a message without fields has a byte that means nothing.
            const auto nothing = [](io::MessageWriter& out) {
                if (out.is_cdr()) out.number(std::uint8_t{0});
            };
            const bool is_half = pass == 0 && k == scans.size() / 2;
            if (o.save && is_half && o.save_as.empty()) ask("/save_map", nothing);
            if (o.save && is_half && !o.save_as.empty()) {
                ask("/save_map_as", [&](io::MessageWriter& out) { out.text(o.save_as); });
            }
            if (o.reset && is_half) ask("/reset", nothing);
            if (o.pause && pass == 0 && (is_half || k == scans.size() * 3 / 4)) {
                ask("/pause", [&](io::MessageWriter& out) {
                    out.number(static_cast<std::uint8_t>(is_half ? 1 : 0));
                });
            }
            bus.publish("/tf", 0.0, poses);
            refused += bus.publish(o.topic, 0.0, points) ? 0U : 1U;
        }
    }
    const double played = std::chrono::duration<double>(Clock::now() - start).count();
    eventually(
        [&] {
            const std::lock_guard hold(heard.lock);
            return heard.labels == sent;
        },
        3.0);
    if (o.save) {
        eventually(
            [&] {
                const std::lock_guard hold(heard.lock);
                return !heard.saved.empty();
            },
            10.0);
    }
    bus.stop();
    std::string others;
    for (const auto& [name, count] : heard.others)
        others += fmt::format(", \"{}\": {}", name, count);
    if (o.save) others += ", \"answer\": " + (heard.saved.empty() ? "null" : heard.saved);
    if (o.check) others += fmt::format(", \"differing\": {}", differing_labels(o, heard));
    fmt::print(
        "{{\"sent\": {}, \"refused\": {}, \"labels\": {}, \"foreign\": {}, \"dynamic\": {}, "
        "\"seconds\": {:.1f}, \"p50_ms\": {:.1f}, \"p99_ms\": {:.1f}, \"most_ms\": {:.1f}{}}}\n",
        sent, refused, heard.labels, heard.unknown_stamps, heard.dynamic, played,
        at_share(heard.latencies, 0.5), at_share(heard.latencies, 0.99),
        at_share(heard.latencies, 1.0), others);
    return heard.labels == sent ? 0 : 4;
}

void add_player_options(CLI::App& app, PlayerOptions& o) {
    app.add_option("BAG", o.bag)->required();
    app.add_option("--speed", o.speed);
    app.add_option("--passes", o.passes);
    app.add_option("--topic", o.topic);
    app.add_option("--prefix", o.prefix);
    app.add_option("--answer", o.answer);
    app.add_option("--wait", o.wait);
    app.add_option("--jump", o.jump);
    app.add_flag("--all", o.all);
    app.add_flag("--save", o.save);
    app.add_option("--save-as", o.save_as);
    app.add_flag("--reset", o.reset);
    app.add_flag("--pause", o.pause);
    app.add_flag("--check", o.check);
}

}  // namespace dynamic_filter::live
