// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "check/advice.hpp"
#include "check/continuity.hpp"
#include "check/motion.hpp"
#include "check/motion_look.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "recording/data_options.hpp"
#include "recording/drives.hpp"
#include "recording/scans.hpp"
#include "run/trial_run.hpp"

namespace dynamic_filter::app {
namespace {

struct CheckOptions {
    std::vector<std::filesystem::path> recordings;  ///< or lists of them
    DataOptions how;  ///< how to read each of them; its `data` is not used
};

/// What a check of one recording finds.
struct Checked {
    io::Recording recording;  ///< with poses that were found, if it had none
    io::Preflight preflight;
    std::vector<io::Finding> findings;  ///< of the preflight, or else of what was tried

    [[nodiscard]] bool is_fine() const {
        return findings.empty() && preflight.unusable.empty() && recording.info().losses.empty();
    }
};

/// Filters a part of the recording as a run would, and watches the result.
std::vector<io::Alarm> alarms_of_part(io::Recording recording, const DataOptions& options,
                                      io::MotionLook& look) {
    Config config = preset("default");
    if (recording.info().has_poses) {
        choose_motion(recording, config, {.deskew = options.deskew, .look = &look});
    }
    return try_run(recording, config);
}

Checked look_at(io::Recording recording, const DataOptions& options) {
    ensure_poses(recording, preset("default"),
                 {.deskew = options.deskew, .finds_body = !options.mask});
    io::MotionLook look(recording, preset("default").odometry, options.deskew);
    Checked checked{recording, io::check_recording(recording, io::Depth::thorough, look), {}};
    for (const io::Finding& finding : checked.preflight.findings) {
        checked.findings.push_back(blame_needless_fix(finding, options));
    }
    // Where the cause is known already, its effect is no news.
    if (!checked.findings.empty()) return checked;
    const auto add = [&](const std::vector<io::Alarm>& alarms, const char* of) {
        for (const io::Alarm& alarm : alarms) {
            checked.findings.push_back({of + io::to_text(alarm, recording), alarm.advice});
        }
    };
    if (recording.info().has_poses) add(io::breaks_in(recording), "");
    add(alarms_of_part(recording, options, look), "of a part that was filtered, ");
    return checked;
}

void print_overlays(const io::Preflight& preflight) {
    if (preflight.overlays.empty()) return;
    say("overlay   share of structures that another scan shows in the same place, if "
        "poses are read\n");
    for (const io::Overlay& overlay : preflight.overlays) {
        say("overlay   {:>3.0f} %  {}\n", 100.0 * overlay.share, overlay.reading);
    }
}

bool is_option(const std::string& advice) { return advice.starts_with("--"); }

void print_finding(const io::Finding& finding, const DataOptions& options) {
    say("FOUND     {}\n", finding.what);
    if (is_option(finding.advice)) {
        say("try       {}\n", next_command(options, finding.advice));
    } else {
        say("advice    {}\n", finding.advice);
    }
}

void print(const Checked& checked, const DataOptions& options) {
    const io::Info& info = checked.recording.info();
    for (const std::string& note : info.notes) say("note      {}\n", note);
    say("scans     {}, of which {} were read\n", checked.recording.size(), checked.preflight.scans);
    print_overlays(checked.preflight);
    for (const std::string& note : checked.preflight.notes) say("note      {}\n", note);
    for (const std::string& line : info.losses) say("LOST      {}\n", line);
    for (const std::string& line : checked.preflight.unusable) say("UNUSABLE  {}\n", line);
    for (const io::Finding& finding : checked.findings) print_finding(finding, options);
}

/// Checks the recording again with the options that were advised, one after the other, and says
/// what is left with them.
void try_advice(Checked checked, DataOptions options) {
    constexpr int kMost = 3;
    std::string given;
    for (int round = 0; round < kMost; ++round) {
        std::optional<DataOptions> more;
        const auto advised = std::find_if(checked.findings.begin(), checked.findings.end(),
                                          [&](const io::Finding& finding) {
                                              more = with_option(options, finding.advice);
                                              return more.has_value();
                                          });
        if (!more) break;
        given += (given.empty() ? "" : " ") + advised->advice;
        options = *std::move(more);
        checked = look_at(open(options), options);
    }
    if (given.empty()) return;
    if (checked.findings.empty()) {
        say("tried     with {}, nothing suspicious is left\nnext      {}\n", given,
            next_command(options, ""));
    } else {
        say("tried     with {}, this is left: {}\n", given, checked.findings.front().what);
    }
}

std::string match_text(const io::DriveOffset& offset) {
    switch (offset.match) {
        case io::FrameMatch::equal:
            return fmt::format("their scans overlay at {} of {} places", offset.fitting,
                               offset.places);
        case io::FrameMatch::shifted:
            return fmt::format("one offset explains {} of {} places", offset.agreeing,
                               offset.places);
        case io::FrameMatch::drifting:
            return fmt::format("{} places differ by different offsets", offset.fitting);
        case io::FrameMatch::unlike:
            return fmt::format("their scans fit together at none of {} places", offset.places);
        case io::FrameMatch::apart:
            return fmt::format("they do not meet; {:.0f} m lie between them", offset.gap);
        case io::FrameMatch::same_poses:
            return "their poses are the same";
        case io::FrameMatch::not_known:
            break;
    }
    return "not compared";
}

/// True if nothing was found.
bool check_together(const std::vector<io::Recording>& opened,
                    const std::vector<DataOptions>& each) {
    // Scans that the motion of the sensor distorts overlay badly, so it is undone as in a run.
    std::vector<io::Recording> drives = opened;
    std::vector<const io::Recording*> all;
    for (io::Recording& drive : drives) {
        Config config = preset("default");
        if (drive.info().has_poses) {
            choose_motion(drive, config, {.refine = "off", .deskew = each.front().deskew});
        }
        all.push_back(&drive);
    }
    const std::vector<io::DriveOffset> offsets = io::measure_drive_offsets(all);
    say("together\n");
    for (const io::DriveOffset& offset : offsets) {
        say("frames    {} and {}: {}\n", each[offset.a].data.string(), each[offset.b].data.string(),
            match_text(offset));
    }
    const std::vector<io::Finding> findings = io::findings_of(all, offsets);
    for (const io::Finding& finding : findings) print_finding(finding, each.front());
    return findings.empty();
}

}  // namespace

int check(const CheckOptions& options) {
    const std::vector<DataOptions> each = options_of(expand(options.recordings), options.how);
    const bool several = each.size() > 1;
    std::vector<io::Recording> opened;
    for (const DataOptions& one : each) opened.push_back(open(one));
    bool fine = true;
    for (std::size_t i = 0; i < opened.size(); ++i) {
        if (several) say("recording {}\n", each[i].data.string());
        const Checked checked = look_at(opened[i], each[i]);
        print(checked, each[i]);
        try_advice(checked, each[i]);
        fine = checked.is_fine() && fine;
        if (several) say("\n");
    }
    if (several) fine = check_together(opened, each) && fine;
    if (!fine) return kRejected;
    say("nothing suspicious\nnext      {}\n", next_command(options.recordings, options.how, ""));
    return kDone;
}

void add_check(Program& program) {
    Command c =
        program.command("check", "Look for mistakes in poses, frames and stamps of recordings");
    const auto o = std::make_shared<CheckOptions>();
    c.paths("DATA", o->recordings,
            "recording; or several in one world frame, or a list of them (.txt), which are then "
            "compared")
        .required();
    add_reading_options(c, o->how);
    add_selection_options(c, o->how);
    c.action([o] { return check(*o); });
}

}  // namespace dynamic_filter::app
