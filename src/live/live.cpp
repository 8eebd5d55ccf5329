// SPDX-License-Identifier: MIT
#include "live/live.hpp"

#include <fmt/format.h>

#include <sstream>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "live/diagnosis.hpp"
#include "live/dry_run.hpp"
#include "live/foxglove_server.hpp"
#include "live/map_saver.hpp"
#include "live/requests.hpp"
#include "live/subscriptions.hpp"

namespace dynamic_filter::live {

namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

std::unique_ptr<FoxgloveServer> serve(const LiveConfig& config, io::MessageEncoding encoding) {
    if (!config.foxglove.serve) return nullptr;
    FoxgloveOptions options;
    options.address = config.foxglove.address;
    options.port = static_cast<std::uint16_t>(config.foxglove.port);
    options.origins = words_of(config.foxglove.origins);
    return std::make_unique<FoxgloveServer>(encoding, options);
}

std::string scans(std::uint64_t count) {
    return fmt::format("{} scan{}", count, count == 1 ? "" : "s");
}

/// Says what is new, once a second at most.
class Chores {
public:
    Chores(Bus& bus, LiveConfig& config, Intake& intake, Subscriptions& subscriptions,
           Session& session, Outputs& outputs, FoxgloveServer* foxglove, MapSaver* saver,
           Requests& requests, bool quiet)
        : bus_(bus),
          config_(config),
          intake_(intake),
          subscriptions_(subscriptions),
          session_(session),
          outputs_(outputs),
          foxglove_(foxglove),
          saver_(saver),
          requests_(requests),
          quiet_(quiet) {}

    void run() {
        const auto now = Clock::now();
        const bool settled = !subscriptions_.cloud().empty();
        if (now < next_) return;
        next_ = now + (settled ? std::chrono::milliseconds(1000) : std::chrono::milliseconds(200));
        subscriptions_.update();
        use_parameters();
        tell(bus_.pop_notices());
        if (foxglove_ != nullptr) tell(foxglove_->pop_notices());
        tell(subscriptions_.pop_notices());
        tell(intake_.pop_notices());
        tell(session_.pop_notices());
        const Figures figures = figures_now();
        watch_input(figures);
        watch_poses(figures);
        watch_speed(figures);
        watch_result(figures);
        outputs_.diagnostics(
            diagnose(figures, before_, config_.output.prefix.substr(1), config_.input.silence),
            seconds_since_epoch());
        before_ = figures;
    }

    /// At once, not once a second.
    void use_requests() {
        if (saver_ != nullptr) {
            saver_->run();
            for (const Saved& result : saver_->pop_results()) tell_saved(result);
        }
        if (requests_.pop_reset()) {
            session_.begin_anew();
            tell({"a message asked for a new map; it begins with the next scan"});
        }
        const bool is_paused = requests_.is_paused();
        if (std::exchange(was_paused_, is_paused) == is_paused) return;
        tell({is_paused ? "a message asked for a pause; scans are left out" : "the pause is over"});
    }

    /// A scan that came during a pause.
    void leave_out() { ++left_out_; }

    [[nodiscard]] Figures figures_now() const {
        return {.intake = intake_.counters(),
                .filter = session_.counters(),
                .latencies = session_.latencies(),
                .odometry = session_.odometry(),
                .alarm = session_.alarm(),
                .origin = intake_.origin(),
                .cloud = subscriptions_.cloud(),
                .poses = intake_.poses_text(),
                .silence = intake_.silence(),
                .published = session_.published(),
                .unpublished = session_.unpublished(),
                .lost = bus_.lost(),
                .not_taken = outputs_.not_taken(),
                .left_out = left_out_,
                .is_paused = requests_.is_paused()};
    }

private:
    void tell(const std::vector<std::string>& notices) {
        if (quiet_) return;
        for (const std::string& notice : notices) app::say(stderr, "note: {}\n", notice);
    }
    void tell_saved(const Saved& result) {
        requests_.answer(result);
        if (result.is_saved) return tell(std::vector<std::string>{result.text});
        warn(result.text);
    }
    static void warn(const std::string& text) { app::say(stderr, "warning: {}\n", text); }

    void use_parameters() {
        for (const auto& [key, value] : bus_.pop_parameters()) {
            try {
                change(config_, key, value);
                session_.set_map(config_.output.map_rate, config_.output.map_radius);
                tell({fmt::format("{} is {} now", key, value)});
            } catch (const ConfigError& error) {
                warn(error.what());
            }
        }
    }

    void watch_input(const Figures& now) {
        const double limit = config_.input.silence;
        const bool silent = now.silence ? *now.silence > limit
                                        : Clock::now() - start_ >
                                              std::chrono::duration<double>(std::max(limit, 5.0));
        if (silent == silent_) return;
        silent_ = silent;
        if (!silent) return tell({"scans come"});
        if (now.silence) {
            return warn(fmt::format("no scan for {:.0f} s; is the driver of {} still running?",
                                    *now.silence, now.cloud));
        }
        warn(fmt::format("no scan yet on {}; `--dry-run` says what is there",
                         now.cloud.empty() ? "any topic" : now.cloud));
    }

    /// Again only after a while, because the reason hardly ever changes.
    void watch_poses(const Figures& now) {
        constexpr auto kPause = std::chrono::seconds(10);
        const std::uint64_t missing = now.intake.without_pose - told_missing_;
        if (missing == 0 || Clock::now() < next_missing_) return;
        next_missing_ = Clock::now() + kPause;
        told_missing_ = now.intake.without_pose;
        warn(fmt::format("no pose for {}: {}", scans(missing), intake_.last_missing()));
    }

    void watch_speed(const Figures& now) {
        constexpr auto kPause = std::chrono::seconds(10);
        const std::uint64_t all = now.filter.dropped + now.intake.overrun;
        const std::uint64_t dropped = all - told_dropped_;
        if (dropped == 0 || Clock::now() < next_dropped_) return;
        next_dropped_ = Clock::now() + kPause;
        told_dropped_ = all;
        warn(fmt::format("dropped {}, because the filter is too slow for the sensor",
                         scans(dropped)));
    }

    void watch_result(const Figures& now) {
        constexpr auto kPause = std::chrono::seconds(10);
        if (now.alarm.empty() || Clock::now() < next_alarm_) return;
        next_alarm_ = Clock::now() + kPause;
        warn(
            fmt::format("of the newest scans, {}; wrong poses, other clocks or several sensors in "
                        "one cloud do so: record with --record, and see `dynamicfilter check`",
                        now.alarm));
    }

    Bus& bus_;
    LiveConfig& config_;
    Intake& intake_;
    Subscriptions& subscriptions_;
    Session& session_;
    Outputs& outputs_;
    FoxgloveServer* foxglove_;  // may be null
    MapSaver* saver_;           // may be null
    Requests& requests_;
    bool was_paused_ = false;
    std::uint64_t left_out_ = 0;  // scans
    bool quiet_;
    Figures before_;
    bool silent_ = false;
    std::uint64_t told_missing_ = 0, told_dropped_ = 0;
    Clock::time_point start_ = Clock::now(), next_ = start_, next_missing_ = start_,
                      next_dropped_ = start_, next_alarm_ = start_;
};

/// Saves the map of the whole drive, as far as the filter holds it.
int finish(MapSaver& saver, bool quiet) {
    const Saved saved = saver.save();
    if (!saved.is_saved) app::say(stderr, "warning: {}\n", saved.text);
    if (saved.is_saved && !quiet) app::say(stderr, "{}\n", saved.text);
    return saved.is_saved ? app::kDone : app::kRejected;
}

/// Runs `run` on each recorded bag. After SIGTERM it only names the bags, because a supervisor is
/// waiting.
int finish(const Recorder& recorder, const std::vector<fs::path>& folders, const LiveOptions& o,
           const LiveConfig& config, bool own_poses) {
    int worst = app::kDone;
    if (folders.empty()) app::say(stderr, "note: no scan was judged, so nothing is recorded\n");
    for (const fs::path& folder : folders) {
        const fs::path bag = recorder.bag_of(folder);
        app::say(stderr, "recorded {}\n", bag.string());
        if (app::terminated()) continue;
        worst =
            std::max(worst, finish_recording(bag, folder, config, own_poses, o.overwrite, o.quiet));
    }
    return worst;
}

}  // namespace

int live(Bus& bus, const LiveOptions& o, LiveConfig config) {
    if (o.settings) {
        app::say("{}", to_toml(config));
        return app::kDone;
    }
    if (o.dry_run) return dry_run(bus, config, o.look);
    std::optional<Recorder> recorder;
    if (o.record) {
        recorder.emplace(*o.record, bus.encoding(), o.overwrite, cloud_topics(config).size() > 1);
    }
    const auto foxglove = serve(config, bus.encoding());
    if (!o.quiet) {
        app::say(stderr, "listens  {}\n", bus.description());
        if (foxglove) app::say(stderr, "foxglove {}\n", foxglove->url());
    }
    app::catch_interrupts();
    Intake intake(config);
    Outputs outputs(config, bus.encoding(), bus, foxglove.get());
    Session session(config, outputs, recorder ? &*recorder : nullptr);
    std::optional<MapSaver> saver;
    if (o.map) {
        saver.emplace(session, *o.map, o.overwrite);
        catch_save_requests();
    }
    Requests requests(bus, config.output.prefix, saver ? &*saver : nullptr);
    Subscriptions subscriptions(bus, config, intake);
    Chores chores(bus, config, intake, subscriptions, session, outputs, foxglove.get(),
                  saver ? &*saver : nullptr, requests, o.quiet);
    while (!app::interrupted()) {
        chores.run();
        chores.use_requests();
        if (session.is_busy()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            continue;
        }
        constexpr double kMoment = 0.05;  // [s]
        auto scan = intake.pop(kMoment);
        if (scan && requests.is_paused()) {
            chores.leave_out();
        } else if (scan) {
            session.push(*std::move(scan));
        }
    }
    requests.end();
    bus.stop();  // before what receives its messages goes
    session.stop();
    const Figures figures = chores.figures_now();
    if (!o.quiet) app::say("{}", to_text(figures));
    // The drive first, because a supervisor may not wait for the map.
    const std::vector<fs::path> recorded = recorder ? recorder->commit() : std::vector<fs::path>{};
    const int of_map = saver ? finish(*saver, o.quiet) : app::kDone;
    if (!recorder) return of_map;
    return std::max(of_map,
                    finish(*recorder, recorded, o, config, figures.origin == PoseOrigin::odometry));
}

}  // namespace dynamic_filter::live
