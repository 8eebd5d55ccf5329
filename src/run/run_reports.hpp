// SPDX-License-Identifier: MIT
/// What a run says about itself: figures, log and page.
#pragma once

#include <nlohmann/json.hpp>

#include "run/run_pass.hpp"

namespace dynamic_filter::app {

/// "95.5 % static, 4.5 % dynamic, 0.0 % unknown": of the points.
std::string shares_of(const RunSummary& summary);

/// The closing table.
std::string to_text(const RunSummary& summary);

/// metrics.json. `losses`: what of the recording cannot be read.
nlohmann::ordered_json metrics_of(const RunSummary& summary,
                                  const std::vector<std::string>& losses);

/// Stages of the whole process, for timing.json.
nlohmann::ordered_json by_stage(const StageClock& clock);
std::size_t peak_rss_bytes();

/// metrics.json, timing.json, run.log, report.html; what the maps hold and what it all took goes
/// into the summary, too.
void write_reports(Pass& pass);

}  // namespace dynamic_filter::app
