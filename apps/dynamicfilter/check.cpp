// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "advice.hpp"
#include "commands.hpp"
#include "dynamic_filter/io/preflight.hpp"
#include "frames.hpp"
#include "motion.hpp"

namespace dynamic_filter::app {

int check(const DataOptions& options) {
    io::Sequence sequence = open(options);
    ensure_poses(sequence, preset("default"), options.deskew, true);
    for (const std::string& note : sequence.notes) fmt::print("note      {}\n", note);
    const io::Preflight preflight = io::check_recording(sequence, io::Depth::thorough);
    fmt::print("scans     {}, of which {} were read\n", sequence.size(), preflight.scans);
    if (!preflight.overlays.empty()) {
        fmt::print(
            "overlay   share of structures that another scan shows in the same place, if "
            "poses are read\n");
    }
    for (const io::Overlay& overlay : preflight.overlays) {
        fmt::print("overlay   {:>3.0f} %  {}\n", 100.0 * overlay.share, overlay.reading);
    }
    for (const std::string& line : sequence.losses) fmt::print("LOST      {}\n", line);
    for (const std::string& line : preflight.unusable) fmt::print("UNUSABLE  {}\n", line);
    for (const io::Finding& found : preflight.findings) {
        const io::Finding finding = blame_needless_fix(found, options);
        fmt::print("FOUND     {}\n", finding.what);
        if (finding.advice.starts_with("--")) {
            fmt::print("try       {}\n", next_command(options, finding.advice));
        } else {
            fmt::print("advice    {}\n", finding.advice);
        }
    }
    const bool fine =
        preflight.findings.empty() && preflight.unusable.empty() && sequence.losses.empty();
    if (fine) fmt::print("nothing suspicious\nnext      {}\n", next_command(options, ""));
    return fine ? kDone : kRejected;
}

}  // namespace dynamic_filter::app
