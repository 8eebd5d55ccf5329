// SPDX-License-Identifier: MIT
/// What a run says about itself: figures, log and page.
#pragma once

#include <nlohmann/json.hpp>

#include "run_pass.hpp"

namespace dynamic_filter::app {

/// What it cost so far, `seconds` of wall time; goes into the summary, too.
nlohmann::ordered_json measure(Pass& pass, double seconds);

/// The closing table.
std::string to_text(const RunSummary& summary);

/// metrics.json, timing.json, run.log, report.html.
void write_reports(Pass& pass, nlohmann::ordered_json timing);

}  // namespace dynamic_filter::app
