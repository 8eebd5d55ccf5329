// SPDX-License-Identifier: MIT
/// What `convert` makes of a recording, scan by scan.
#pragma once

#include <cstddef>
#include <memory>
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
    /// `labels` are verdicts or ground truth, empty if there are none.
    virtual void append(const io::FullScan& scan, const Labels& labels) = 0;
    /// Returns what the format could not hold, as a sentence; empty if it held all. Without this
    /// call, no file is left.
    virtual std::string commit() = 0;
};

/// Chooses the sink by the output's name and --to. Throws ConfigError before any work is done.
std::unique_ptr<Sink> make_sink(const ConvertOptions& options);

/// Throws ConfigError if the output is no cloud file that can be written, or is there already.
void check_cloud_output(const ConvertOptions& options);

/// Adds record i.
void append_record(std::vector<std::byte>& to, std::span<const std::byte> records, std::size_t i,
                   std::size_t bytes);

}  // namespace dynamic_filter::app
