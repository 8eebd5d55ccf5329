// SPDX-License-Identifier: MIT
#include "live/dry_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/edit_distance.hpp"
#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/messages/packets.hpp"
#include "live/outputs.hpp"
#include "live/subscriptions.hpp"

namespace dynamic_filter::live {

namespace {

using Clock = std::chrono::steady_clock;

/// What came while it listened.
struct Seen {
    UsableTopics topics;
    std::string cloud;
    std::vector<std::string> missing;  ///< topics of input.cloud that nobody publishes
    std::string ambiguous;             ///< why no topic of scans could be chosen
    std::size_t scans = 0;             ///< with poses, or to be tracked
    std::optional<LiveScan> first, last;
    double delay = 0.0;  ///< [s] of the newest stamp behind the clock of this machine
    IntakeCounters counters;
    PoseOrigin origin = PoseOrigin::undecided;
    std::string poses;
    std::vector<std::string> notices;
};

Seen listen_to(Bus& bus, const LiveConfig& config, double look) {
    Seen seen;
    Intake intake(config);
    Subscriptions subscriptions(bus, config, intake);
    const auto end = Clock::now() + std::chrono::duration<double>(look);
    while (Clock::now() < end && !app::interrupted()) {
        try {
            subscriptions.update();
        } catch (const ConfigError& error) {
            seen.ambiguous = error.what();
        }
        constexpr double kMoment = 0.1;  // [s]
        auto scan = intake.pop(kMoment);
        if (!scan) continue;
        ++seen.scans;
        seen.delay = seconds_since_epoch() - scan->stamp;
        if (!seen.first) seen.first = *scan;
        seen.last = std::move(*scan);
    }
    seen.topics = usable(bus.seen());
    seen.cloud = subscriptions.cloud();
    seen.missing = subscriptions.missing();
    seen.counters = intake.counters();
    seen.origin = intake.origin();
    seen.poses = intake.poses_text();
    seen.notices = intake.pop_notices();
    return seen;
}

void print_topics(const UsableTopics& topics) {
    const auto print = [](const std::vector<SeenTopic>& list, const std::string& use) {
        for (const SeenTopic& t : list) {
            app::say("topic    {:<28} {:<28} {}{}{}\n", t.name, t.type, use,
                     t.offered.reliable ? "" : ", best effort",
                     t.publishers > 1 ? fmt::format(", {} publishers", t.publishers) : "");
        }
    };
    print(topics.clouds, "scans");
    print(topics.poses, "poses");
    print(topics.transforms, "transforms");
    for (const SeenTopic& t : topics.packets) {
        app::say("topic    {:<28} {:<28} raw packets\n", t.name, t.type);
    }
}

void print_scans(const Seen& seen) {
    if (!seen.first) return;
    const LiveScan& scan = *seen.last;
    std::vector<std::string> fields;
    for (const io::Field& field : scan.cloud.fields) fields.push_back(field.name);
    const double span = scan.stamp - seen.first->stamp;
    const double rate = span > 0.0 ? static_cast<double>(seen.scans - 1) / span : 0.0;
    app::say("scans    {}: {:.1f} Hz, {} points, frame '{}'; fields {}\n", seen.cloud, rate,
             scan.cloud.size(), scan.frame, fmt::join(fields, " "));
    app::say("poses    {}\n", seen.poses);
}

std::string nothing_there(const Bus& bus) {
    return fmt::format(
        "nothing is published that could be used ({}): does the driver run, on this domain or "
        "master, and on this network?",
        bus.description());
}

std::string no_such_cloud(const Seen& seen, const std::string& wanted) {
    const std::vector<std::string> known = names_of(seen.topics.clouds);
    const std::string nearest = nearest_word(wanted, known);
    return fmt::format("nobody publishes scans on {}{}{}", wanted,
                       known.empty() ? "" : fmt::format("; there are: {}", fmt::join(known, ", ")),
                       nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

std::string needs_driver(const SeenTopic& packets) {
    return fmt::format(
        "{} has the raw packets of a sensor; start the driver that makes clouds of "
        "them: {}",
        packets.name, io::driver_of(packets.type));
}

/// What keeps the filter from working, most important first.
std::vector<std::string> problems_of(const Seen& seen, const Bus& bus, const LiveConfig& config) {
    std::vector<std::string> problems;
    const UsableTopics& t = seen.topics;
    if (!seen.ambiguous.empty()) problems.push_back(seen.ambiguous);
    if (t.clouds.empty() && !t.packets.empty()) problems.push_back(needs_driver(t.packets.front()));
    if (t.clouds.empty() && t.packets.empty() && t.poses.empty() && t.transforms.empty()) {
        problems.push_back(nothing_there(bus));
    } else if (!seen.missing.empty()) {
        for (const std::string& topic : seen.missing) {
            problems.push_back(no_such_cloud(seen, topic));
        }
    } else if (seen.cloud.empty() && seen.ambiguous.empty() && t.packets.empty()) {
        problems.emplace_back("nobody publishes a PointCloud2 or a CustomMsg of Livox");
    } else if (!seen.cloud.empty() && seen.counters.received == 0) {
        problems.push_back(fmt::format(
            "{} is announced, but nothing came: a firewall, a network that loses large packets, or "
            "a publisher whose QoS does not fit (see --set input.qos=best_effort)",
            seen.cloud));
    }
    if (seen.counters.without_pose > 0) {
        problems.push_back(fmt::format("{} of {} scans have no pose: {}",
                                       seen.counters.without_pose, seen.counters.received,
                                       seen.poses));
    }
    if (seen.counters.malformed > 0) {
        problems.push_back(fmt::format("{} scans cannot be read", seen.counters.malformed));
    }
    const bool timed = seen.last && !io::point_times(seen.last->cloud, seen.last->stamp).empty();
    if (seen.last && config.input.deskew && !timed) {
        problems.emplace_back("input.deskew is on, but the scans hold no times of their points");
    }
    return problems;
}

std::vector<std::string> notes_of(const Seen& seen) {
    std::vector<std::string> notes = seen.notices;
    constexpr double kOtherClock = 5.0;  // [s]
    if (seen.last && std::abs(seen.delay) > kOtherClock) {
        notes.push_back(fmt::format(
            "the stamps of the scans are {:.0f} s {} the clock of this machine: a bag, a "
            "simulation, or a sensor that is not synchronised; poses must have the same clock",
            std::abs(seen.delay), seen.delay > 0 ? "behind" : "ahead of"));
    }
    if (seen.origin == PoseOrigin::odometry) {
        notes.emplace_back("poses will be found by odometry; --set input.pose=... takes others");
    }
    return notes;
}

}  // namespace

int dry_run(Bus& bus, const LiveConfig& config, double look) {
    app::catch_interrupts();
    app::say("bus      {}\n", bus.description());
    const Seen seen = listen_to(bus, config, look);
    print_topics(seen.topics);
    print_scans(seen);
    for (const std::string& note : notes_of(seen)) app::say("note     {}\n", note);
    const auto problems = problems_of(seen, bus, config);
    for (const std::string& problem : problems) app::say("missing  {}\n", problem);
    if (!problems.empty() || seen.scans == 0) {
        if (problems.empty())
            app::say("missing  no scan came in {} s; try a longer --look\n", look);
        return app::kRejected;
    }
    for (const Output& output : OutputTopics(config, bus.encoding()).all()) {
        app::say("gives    {:<28} {}\n", output.topic.name, output.topic.type);
    }
    app::say("fits     {} scans have all that the filter needs\n", seen.scans);
    return app::kDone;
}

}  // namespace dynamic_filter::live
