// SPDX-License-Identifier: MIT
#include "dynamic_filter/online.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <map>
#include <mutex>
#include <thread>

#include "dynamic_filter/error.hpp"
#include "support/outcome.hpp"

namespace dynamic_filter {
namespace online_filter_test {

using test::drive;
using test::expect_same;
using test::RoomScan;
using test::small_windows;

Config every_scan() {
    Config config;
    config.keyframe.interval = 0.0;
    return config;
}

OnlineOptions nothing_lost() {
    OnlineOptions options;
    options.overload = Overload::wait;
    options.horizon = 0.0;
    return options;
}

void expect_balance(const Counters& c) {
    EXPECT_EQ(c.in, c.processed + c.dropped + c.rejected + c.queued);
}

/// Holds up whoever enters until it is opened.
class Gate {
public:
    void enter() {
        entered_.set_value();
        opened_.get_future().wait();
    }
    void wait_for_visitor() { entered_.get_future().wait(); }
    void open() { opened_.set_value(); }

private:
    std::promise<void> entered_, opened_;
};

TEST(OnlineFilter, ByteForByteTheSameAsOffline) {
    const auto scans = drive(20, true);
    for (const Config& config : {every_scan(), small_windows()}) {
        const test::Outcome offline = test::run(scans, config);
        for (const int threads : {1, 3}) {
            OnlineOptions options = nothing_lost();
            options.threads = threads;
            std::vector<Verdict> instant, final;
            OnlineFilter filter(config, options,
                                {.instant = [&](const Verdict& v) { instant.push_back(v); },
                                 .settled = {},
                                 .notice = {}});
            for (const RoomScan& s : scans) filter.push(s.scan);
            filter.finish();
            for (const RoomScan& s : scans) final.push_back(filter.verdict(s.scan));
            expect_same(instant, offline.instant);
            expect_same(final, offline.final);
        }
    }
}

TEST(OnlineFilter, AskReturnsTheVerdictOfThatScan) {
    const auto scans = drive(6, true);
    const test::Outcome offline = test::run(scans, every_scan());
    OnlineFilter filter(every_scan(), nothing_lost());
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto verdict = filter.ask(scans[i].scan);
        ASSERT_TRUE(verdict) << i;
        EXPECT_EQ(verdict->index, i);
        EXPECT_EQ(verdict->labels, offline.instant[i].labels) << i;
    }
    EXPECT_FALSE(filter.ask(scans[4].scan));  // late
    EXPECT_EQ(filter.counters().rejected, 1U);
    EXPECT_GT(filter.local_static_map(scans[3].scan.T_world_sensor).size(), 500U);
    filter.finish();
    EXPECT_EQ(filter.static_map().size(),
              filter.local_static_map(scans[3].scan.T_world_sensor, 1e6).size());
}

TEST(OnlineFilter, SaysAtAnyTimeWhatItThinksOfAScan) {
    const auto scans = drive(6, true);
    OnlineFilter filter(every_scan(), nothing_lost());
    DynamicFilter offline(every_scan());
    EXPECT_EQ(filter.settled(scans[0].scan).labels,
              Labels(scans[0].scan.points.size(), Label::unknown));
    for (const RoomScan& s : scans) {
        filter.push(s.scan);
        filter.flush();
        offline.push(s.scan);
        EXPECT_EQ(filter.settled(scans[0].scan).labels, offline.settled(scans[0].scan).labels);
    }
}

TEST(OnlineFilter, UnderOverloadTheOldestWaitingScanIsDroppedAndCounted) {
    const auto scans = drive(12, false);
    Gate gate;
    std::vector<std::size_t> judged, dropped;
    OnlineOptions options;
    options.queue = 3;
    OnlineFilter filter(every_scan(), options,
                        {.instant =
                             [&](const Verdict& v) {
                                 if (v.index == 0) gate.enter();
                                 judged.push_back(v.index);
                             },
                         .settled = {},
                         .notice =
                             [&](const Notice& n) {
                                 EXPECT_EQ(n.kind, NoticeKind::dropped);
                                 dropped.push_back(n.index);
                             }});
    filter.push(scans[0].scan);
    gate.wait_for_visitor();
    for (std::size_t i = 1; i < scans.size(); ++i) {
        filter.push(scans[i].scan);
        expect_balance(filter.counters());
        EXPECT_LE(filter.counters().queued, 4U);
    }
    EXPECT_EQ(dropped, (std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8}));
    gate.open();
    filter.finish();
    EXPECT_EQ(judged, (std::vector<std::size_t>{0, 9, 10, 11}));
    const Counters c = filter.counters();
    EXPECT_EQ(c.in, 12U);
    EXPECT_EQ(c.processed, 4U);
    EXPECT_EQ(c.dropped, 8U);
    EXPECT_EQ(c.queued, 0U);
}

TEST(OnlineFilter, AFaultInAStageReachesTheCaller) {
    const auto scans = drive(6, false);
    OnlineFilter filter(every_scan(), nothing_lost(),
                        {.instant =
                             [](const Verdict& v) {
                                 if (v.index == 2) throw std::runtime_error("full disk");
                             },
                         .settled = {},
                         .notice = {}});
    EXPECT_THROW(
        {
            for (const RoomScan& s : scans) filter.push(s.scan);
            filter.flush();
        },
        std::runtime_error);
    EXPECT_THROW(filter.push(scans[5].scan), std::runtime_error);
    EXPECT_THROW(filter.ask(scans[5].scan), std::runtime_error);
    EXPECT_THROW(filter.finish(), std::runtime_error);
    expect_balance(filter.counters());
    EXPECT_EQ(filter.counters().processed, 2U);
}

TEST(OnlineFilter, AFaultInTheBackEndIsCountedOnce) {
    const auto scans = drive(8, false);
    OnlineOptions options = nothing_lost();
    options.settle_after = 1;
    for (int i = 0; i < 20; ++i) {
        OnlineFilter filter(every_scan(), options,
                            {.instant = {},
                             .settled = [](const Verdict&) { throw std::runtime_error("no"); },
                             .notice = {}});
        EXPECT_THROW(
            {
                for (const RoomScan& s : scans) filter.push(s.scan);
                filter.flush();
            },
            std::runtime_error);
        while (filter.counters().queued > 0) std::this_thread::yield();
        expect_balance(filter.counters());
    }
}

TEST(OnlineFilter, StopsAtOnceWithScansWaiting) {
    const auto scans = drive(8, false);
    std::atomic<int> judged{0};
    {
        Gate gate;
        OnlineOptions options = nothing_lost();
        options.queue = 8;
        OnlineFilter filter(every_scan(), options,
                            {.instant =
                                 [&](const Verdict&) {
                                     if (judged++ == 0) gate.enter();
                                 },
                             .settled = {},
                             .notice = {}});
        for (const RoomScan& s : scans) filter.push(s.scan);
        gate.wait_for_visitor();
        gate.open();
    }
    EXPECT_LT(judged, 8);
}

TEST(OnlineFilter, BeforeAnyScanAllIsUnknown) {
    const auto scans = drive(1, false);
    for (const Config& config : {every_scan(), small_windows()}) {
        OnlineFilter filter(config);
        Scan invalid = scans[0].scan;
        invalid.stamp = std::nan("");
        filter.push(invalid);
        filter.finish();
        EXPECT_TRUE(test::all_are({filter.verdict(scans[0].scan)}, Label::unknown));
        EXPECT_EQ(filter.counters().rejected, 1U);
    }
}

TEST(OnlineFilter, PushAfterFinishIsAnError) {
    const auto scans = drive(2, false);
    OnlineFilter filter(every_scan());
    filter.push(scans[0].scan);
    filter.finish();
    filter.finish();  // is no matter
    EXPECT_THROW(filter.push(scans[1].scan), Error);
}

TEST(OnlineFilter, ACallbackThatWaitsForItIsAnError) {
    const auto scans = drive(2, false);
    OnlineFilter* own = nullptr;
    OnlineCallbacks callbacks;
    callbacks.instant = [&](const Verdict&) { own->flush(); };
    OnlineFilter filter(every_scan(), nothing_lost(), callbacks);
    own = &filter;
    filter.push(scans[0].scan);
    EXPECT_THROW(filter.flush(), Error);
    EXPECT_THROW(filter.push(scans[1].scan), Error);  // it is of no use any more
}

TEST(OnlineFilter, ACallbackThatFinishesIsAnError) {
    const auto scans = drive(4, false);
    OnlineFilter* own = nullptr;
    OnlineCallbacks callbacks;
    const auto finish = [&](const Verdict&) { own->finish(); };
    for (const bool settled : {false, true}) {
        (settled ? callbacks.settled : callbacks.instant) = finish;
        (settled ? callbacks.instant : callbacks.settled) = {};
        OnlineOptions options = nothing_lost();
        options.settle_after = 3;  // so that finish() itself settles scans
        OnlineFilter filter(every_scan(), options, callbacks);
        own = &filter;
        for (std::size_t i = 0; i < 2; ++i) {
            try {
                filter.push(scans[i].scan);
            } catch (const Error&) {  // of the scan before
            }
        }
        EXPECT_THROW(filter.finish(), Error) << settled;
    }
}

TEST(OnlineFilter, WhetherItJudgesEachScanCanBeAskedAtBreaks) {
    auto scans = drive(2, false);
    OnlineFilter filter(every_scan(), nothing_lost(), {});
    std::atomic<bool> ends{false};
    std::size_t no = 0;
    std::thread asks([&] {
        while (!ends) no += filter.judges_each_scan() ? 0 : 1;
    });
    for (std::size_t i = 0; i < 200; ++i) {
        Scan scan = scans[i % 2].scan;
        scan.points.resize(50);
        scan.index = i;
        scan.stamp = i % 2 == 0 ? 100.0 : 0.0;  // each second one begins a new map
        filter.push(std::move(scan));
    }
    filter.flush();
    ends = true;
    asks.join();
    EXPECT_EQ(no, 0U);
}

TEST(OnlineFilter, RefusesOptionsThatMakeNoSense) {
    OnlineOptions no_queue;
    no_queue.queue = 0;
    EXPECT_THROW(OnlineFilter(Config{}, no_queue), ConfigError);
    OnlineOptions no_number;
    no_number.horizon = std::nan("");
    EXPECT_THROW(OnlineFilter(Config{}, no_number), ConfigError);
    for (const int threads : {-1, 1025, 100000}) {
        EXPECT_THROW(OnlineFilter(Config{}, {.threads = threads}), ConfigError);
    }
    EXPECT_TRUE(violations(OnlineOptions{}).empty());
    no_number.queue = 0;
    EXPECT_EQ(violations(no_number),
              (std::vector<std::string>{"queue = 0 is outside 1.0 .. inf",
                                        "horizon = nan is outside 0.0 .. inf"}));
}

TEST(OnlineFilter, ScansFromSeveralThreadsAreAllAccountedFor) {
    const auto scans = drive(16, false);
    OnlineFilter filter(every_scan());
    std::atomic<bool> done{false};
    std::thread watch([&] {
        while (!done) {
            expect_balance(filter.counters());
            EXPECT_LT(filter.local_static_map(scans[0].scan.T_world_sensor).size(), 100000U);
        }
    });
    std::vector<std::thread> sensors;
    for (std::size_t first = 0; first < 2; ++first) {
        sensors.emplace_back([&, first] {
            for (std::size_t i = first; i < scans.size(); i += 2) filter.push(scans[i].scan);
        });
    }
    for (std::thread& sensor : sensors) sensor.join();
    filter.finish();
    done = true;
    watch.join();
    EXPECT_EQ(filter.counters().in, scans.size());
    EXPECT_EQ(filter.counters().queued, 0U);
}

/// Notices of a run of scans, as kind and index.
using Told = std::vector<std::pair<NoticeKind, std::size_t>>;
Told notices_of(const std::vector<RoomScan>& scans, std::size_t& maps) {
    Told told;
    OnlineFilter filter(every_scan(), nothing_lost(),
                        {.instant = {}, .settled = {}, .notice = [&](const Notice& n) {
                             told.emplace_back(n.kind, n.index);
                         }});
    for (const RoomScan& s : scans) filter.push(s.scan);
    filter.finish();
    maps = filter.maps();
    return told;
}

TEST(OnlineFilter, AfterAJumpOfThePoseNothingIsHeldAgainstWhatWasBefore) {
    auto scans = drive(20, true);
    for (std::size_t i = 10; i < scans.size(); ++i) {
        scans[i].scan.T_world_sensor.translation().y() += 1e3;
    }
    std::size_t maps = 0;
    EXPECT_EQ(notices_of(scans, maps), (Told{{NoticeKind::jump, 10}}));
    EXPECT_EQ(maps, 2U);
    const auto half = scans.begin() + 10;
    auto expected = test::run({scans.begin(), half}, every_scan()).final;
    for (Verdict& v : test::run({half, scans.end()}, every_scan()).final) {
        expected.push_back(std::move(v));
    }
    OnlineFilter filter(every_scan(), nothing_lost());
    for (const RoomScan& s : scans) filter.push(s.scan);
    filter.finish();
    std::vector<Verdict> final;
    for (const RoomScan& s : scans) final.push_back(filter.verdict(s.scan));
    expect_same(final, expected);
}

TEST(OnlineFilter, ARecordingThatLoopsBeginsANewMap) {
    auto scans = drive(8, false);
    for (std::size_t i = 0; i < 8; ++i) {
        scans.push_back(scans[i]);
        scans.back().scan.index = 8 + i;
    }
    std::size_t maps = 0;
    EXPECT_EQ(notices_of(scans, maps), (Told{{NoticeKind::restart, 8}}));
    EXPECT_EQ(maps, 2U);
}

TEST(OnlineFilter, ANewMapBeginsWhereItIsWanted) {
    const auto scans = drive(8, false);
    OnlineFilter filter(every_scan(), nothing_lost());
    for (std::size_t i = 0; i < 8; ++i) {
        if (i == 5) filter.begin_anew();
        filter.push(scans[i].scan);
    }
    filter.finish();
    EXPECT_EQ(filter.maps(), 2U);
    std::vector<Verdict> final;
    for (const RoomScan& s : scans) final.push_back(filter.verdict(s.scan));
    auto expected = test::run({scans.begin(), scans.begin() + 5}, every_scan()).final;
    for (Verdict& v : test::run({scans.begin() + 5, scans.end()}, every_scan()).final) {
        expected.push_back(std::move(v));
    }
    expect_same(final, expected);
}

// Whatever the distance: it is that of the sensors, not that of a way.
TEST(OnlineFilter, SensorsThatAreFarApartAreNoJumps) {
    auto scans = drive(12, false);
    for (std::size_t i = 1; i < 12; i += 2) {
        scans[i].scan.sensor = 1;
        scans[i].scan.T_world_sensor.translation().x() -= 1e3;
    }
    std::size_t maps = 0;
    EXPECT_EQ(notices_of(scans, maps), Told{});
    for (RoomScan& s : scans) s.scan.sensor = 0;
    EXPECT_FALSE(notices_of(scans, maps).empty());
}

TEST(OnlineFilter, AGapInTimeIsNoBreak) {
    auto scans = drive(8, false);
    for (std::size_t i = 4; i < 8; ++i) scans[i].scan.stamp += 60.0;
    std::size_t maps = 0;
    EXPECT_EQ(notices_of(scans, maps), Told{});
    EXPECT_EQ(maps, 1U);
}

TEST(OnlineFilter, SettlesScansAfterAsManyMoreAndTheRestAtTheEnd) {
    const auto scans = drive(12, true);
    OnlineOptions options = nothing_lost();
    options.settle_after = 5;
    std::vector<Verdict> settled;
    OnlineFilter filter(
        every_scan(), options,
        {.instant = {}, .settled = [&](const Verdict& v) { settled.push_back(v); }, .notice = {}});
    for (const RoomScan& s : scans) filter.push(s.scan);
    filter.flush();
    EXPECT_EQ(settled.size(), scans.size() - 5);
    filter.finish();
    ASSERT_EQ(settled.size(), scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(settled[i].index, i);
    const double settled_right = test::share(scans, settled, Label::dynamic, Label::dynamic);
    std::vector<Verdict> instant;
    for (const auto& v : test::run(scans, every_scan()).instant) instant.push_back(v);
    EXPECT_GE(settled_right, test::share(scans, instant, Label::dynamic, Label::dynamic));
}

/// A corridor without end: the same room, again and again, ever farther.
std::vector<RoomScan> corridor(std::size_t count) {
    const auto room = drive(1, false);
    std::vector<RoomScan> scans;
    for (std::size_t i = 0; i < count; ++i) {
        scans.push_back(room[0]);
        scans.back().scan.index = i;
        scans.back().scan.stamp = 0.5 * static_cast<double>(i);
        scans.back().scan.T_world_sensor.translation().x() += 2.0 * static_cast<double>(i);
    }
    return scans;
}

TEST(OnlineFilter, BeyondTheHorizonTheMapIsForgottenAndOnlyThere) {
    const auto scans = corridor(80);
    OnlineOptions near = nothing_lost();
    near.horizon = 30.0;
    for (const Config& config : {every_scan(), small_windows()}) {
        OnlineFilter all(config, nothing_lost()), some(config, near);
        std::vector<std::size_t> voxels;
        for (const RoomScan& s : scans) {
            all.push(s.scan);
            some.push(s.scan);
            some.flush();
            voxels.push_back(some.contents().voxels);
        }
        all.finish();
        some.finish();
        EXPECT_LT(some.contents().voxels, all.contents().voxels / 2);
        EXPECT_LE(voxels.back(), *std::max_element(voxels.begin(), voxels.begin() + 40));
        const Verdict here = some.verdict(scans[78].scan);
        EXPECT_EQ(here.labels, all.verdict(scans[78].scan).labels);
        EXPECT_TRUE(test::all_are({some.verdict(scans[0].scan)}, Label::unknown));
    }
}

TEST(OnlineFilter, BytesBoundTheMapToo) {
    const auto scans = corridor(40);
    OnlineOptions small = nothing_lost();
    small.horizon = 1e6;
    small.max_bytes = 1 << 20;
    OnlineFilter filter(every_scan(), small);
    for (const RoomScan& s : scans) {
        filter.push(s.scan);
        filter.flush();
        EXPECT_LE(filter.contents().voxels, small.max_bytes / 172 + 500);  // and one scan's
    }
    filter.finish();
    OnlineFilter submaps(small_windows(), small);
    for (const RoomScan& s : scans) submaps.push(s.scan);
    submaps.flush();
    EXPECT_LE(submaps.contents().observers, 2U);
}

std::vector<RoomScan> without_poses(std::size_t count) {
    auto scans = drive(count, true);
    for (RoomScan& s : scans) {
        s.scan.has_pose = false;
        s.scan.T_world_sensor = Pose::Identity();
    }
    return scans;
}

/// What the callbacks were told.
struct Heard {
    std::vector<Verdict> instant;
    Told notices;
    std::size_t maps = 0;
};

Heard hear(const std::vector<RoomScan>& scans, const Config& config, int threads = 0) {
    Heard heard;
    OnlineOptions options = nothing_lost();
    options.threads = threads;
    OnlineFilter filter(
        config, options,
        {.instant = [&](const Verdict& v) { heard.instant.push_back(v); },
         .settled = {},
         .notice = [&](const Notice& n) { heard.notices.emplace_back(n.kind, n.index); }});
    for (const RoomScan& s : scans) filter.push(s.scan);
    filter.finish();
    heard.maps = filter.maps();
    return heard;
}

void expect_same_poses(const std::vector<Verdict>& a, const std::vector<Verdict>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_TRUE(a[i].tracked && b[i].tracked) << i;
        EXPECT_EQ(a[i].tracked->T_world_sensor.matrix(), b[i].tracked->T_world_sensor.matrix());
        EXPECT_EQ(a[i].tracked->velocity, b[i].tracked->velocity);
    }
}

TEST(OnlineFilter, AFinalVerdictNeedsThePoseThatTheFilterFound) {
    const std::vector<RoomScan> scans = without_poses(6);
    std::map<std::size_t, Pose> found;
    OnlineCallbacks callbacks;
    callbacks.instant = [&](const Verdict& v) {
        if (v.tracked) found[v.index] = v.tracked->T_world_sensor;
    };
    OnlineFilter filter(every_scan(), nothing_lost(), callbacks);
    for (const RoomScan& s : scans) filter.push(s.scan);
    filter.finish();
    EXPECT_THROW(static_cast<void>(filter.verdict(scans[5].scan)), Error);
    EXPECT_THROW(static_cast<void>(filter.places_of(scans[5].scan)), Error);
    Scan placed = scans[5].scan;
    placed.has_pose = true;
    placed.T_world_sensor = found.at(placed.index);
    EXPECT_FALSE(test::all_are({filter.verdict(placed)}, Label::unknown));
}

TEST(OnlineFilter, WithoutPosesByteForByteTheSameAsOffline) {
    const auto scans = without_poses(16);
    Config refining = every_scan();
    refining.odometry.refine = true;
    for (const Config& config : {every_scan(), small_windows()}) {
        const test::Outcome offline = test::run(scans, config);
        for (const int threads : {1, 4}) {
            const Heard online = hear(scans, config, threads);
            expect_same(online.instant, offline.instant);
            expect_same_poses(online.instant, offline.instant);
            EXPECT_EQ(online.notices, Told{});
        }
    }
    const auto given = drive(16, true);
    const test::Outcome offline = test::run(given, refining);
    const Heard online = hear(given, refining);
    expect_same(online.instant, offline.instant);
    expect_same_poses(online.instant, offline.instant);
}

TEST(OnlineFilter, WithoutPosesARestartBeginsAnew) {
    auto scans = without_poses(8);
    const Heard once = hear(scans, every_scan());
    for (std::size_t i = 0; i < 8; ++i) {
        scans.push_back(scans[i]);
        scans.back().scan.index = 8 + i;
    }
    const Heard twice = hear(scans, every_scan());
    EXPECT_EQ(twice.notices, (Told{{NoticeKind::restart, 8}}));
    EXPECT_EQ(twice.maps, 2U);
    ASSERT_EQ(twice.instant.size(), 16U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(twice.instant[8 + i].labels, once.instant[i].labels) << i;
        EXPECT_EQ(twice.instant[8 + i].tracked->T_world_sensor.matrix(),
                  once.instant[i].tracked->T_world_sensor.matrix());
    }
}

TEST(OnlineFilter, WhereTheOdometryBeginsAnewTheMapDoes) {
    auto scans = without_poses(16);
    for (std::size_t i = 3; i < 13; ++i) {
        scans[i].scan.points.assign(scans[i].scan.points.size(), Point::Zero());
    }
    const Heard heard = hear(scans, every_scan());
    EXPECT_EQ(heard.notices, (Told{{NoticeKind::jump, 12}}));
    EXPECT_EQ(heard.maps, 2U);
    ASSERT_EQ(heard.instant.size(), scans.size());
    for (const Verdict& v : heard.instant) {
        EXPECT_EQ(v.tracked->begins_anew, v.index == 12) << v.index;
    }
}

TEST(OnlineFilter, AScanThatAloneHasOrLacksAPoseOrWhoseTimesAreNotOnePerPointIsRefused) {
    for (const bool with_poses : {false, true}) {
        auto scans = with_poses ? drive(6, true) : without_poses(6);
        scans[2].scan.has_pose = !with_poses;
        scans[4].scan.times.assign(3, 0.0F);
        const Heard heard = hear(scans, every_scan());
        EXPECT_EQ(heard.notices, (Told{{NoticeKind::invalid, 2}, {NoticeKind::invalid, 4}}));
        EXPECT_EQ(heard.instant.size(), 4U);
        EXPECT_EQ(heard.maps, 1U);
    }
}

}  // namespace online_filter_test
}  // namespace dynamic_filter
