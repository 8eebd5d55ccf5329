// SPDX-License-Identifier: MIT
/// What the live filter says about itself: diagnostics for the bus, and the closing table.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "live/session.hpp"

namespace dynamic_filter::live {

/// All counters at one moment.
struct Figures {
    IntakeCounters intake;
    Counters filter;
    Latencies latencies;
    OdometryState odometry;
    std::string alarm;  ///< see Session::alarm()
    PoseOrigin origin = PoseOrigin::undecided;
    std::string cloud, poses;                      ///< topic of the scans; see Intake::poses_text()
    std::optional<double> silence;                 ///< [s] see Intake::silence()
    std::uint64_t published = 0, unpublished = 0;  ///< scans
    std::uint64_t lost = 0, not_taken = 0;         ///< messages: on the way here; by receivers
    std::uint64_t left_out = 0;                    ///< scans that came during a pause
    bool is_paused = false;
};

/// Four rows: input, filter, result, output. `before`: the figures of the last time, so that a row
/// warns of what happens now, not of what once did. `silent_after`: [s] without input that is an
/// error.
std::vector<io::DiagnosticStatus> diagnose(const Figures& now, const Figures& before,
                                           const std::string& name, double silent_after);

/// The closing table.
std::string to_text(const Figures& figures);

}  // namespace dynamic_filter::live
