// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "commands.hpp"
#include "dynamic_filter/io/preflight.hpp"
#include "frames.hpp"

namespace dynamic_filter::app {

int check(const DataOptions& options) {
    const io::Sequence sequence = open(options);
    for (const std::string& note : sequence.notes) fmt::print("note      {}\n", note);
    const io::Preflight preflight = io::check_recording(sequence, io::Depth::thorough);
    fmt::print("scans     {}, of which {} were read\n", sequence.size(), preflight.scans);
    for (const io::Overlay& overlay : preflight.overlays) {
        fmt::print("overlay   {:>3.0f} %  {}\n", 100.0 * overlay.share, overlay.reading);
    }
    for (const io::Finding& finding : preflight.findings) {
        const bool is_option = finding.advice.starts_with("--");
        fmt::print("FOUND     {}\n", finding.what);
        fmt::print(
            fmt::runtime(is_option ? "try       dynamicfilter run {} {}\n" : "try       {1}\n"),
            options.data.string(), finding.advice);
    }
    if (preflight.findings.empty()) fmt::print("nothing suspicious\n");
    return preflight.findings.empty() ? kDone : kRejected;
}

}  // namespace dynamic_filter::app
