// SPDX-License-Identifier: MIT
/// What `convert` makes of a recording, scan by scan, and what its outputs share.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "export/convert_options.hpp"

namespace dynamic_filter::app {

class Sink {
public:
    Sink() = default;
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;
    virtual ~Sink() = default;
    /// `labels` are verdicts or ground truth, empty if there are none. `stem`: name of the scan's
    /// file without its extension.
    virtual void append(const io::FullScan& scan, const Labels& labels,
                        const std::string& stem) = 0;
    /// Returns what the format could not hold, as a sentence; empty if it held all. Without this
    /// call, no file is left.
    virtual std::string commit() = 0;
};

/// Empty labels: nothing is dynamic.
bool is_dynamic(const Labels& labels, std::size_t i);

/// Throws ConfigError if there are no labels, which the output of that name needs.
void require_labels(const Labels& labels, const std::string& output);

/// "left out: a, b", of what a scan has and its format has no place for.
std::string left_out(const std::vector<io::Field>& fields, const std::set<std::string>& kept,
                     const std::string& also = "");

}  // namespace dynamic_filter::app
