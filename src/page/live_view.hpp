// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "page/http_server.hpp"
#include "page/live_feed.hpp"

namespace dynamic_filter::app {

/// The live page of a run, on this machine only. No client is ever waited for, but by linger().
class LiveView {
public:
    /// Throws Error (built without the viewer) and OutputError (port in use).
    LiveView(std::uint16_t port, std::string name, std::string input, std::size_t total);

    [[nodiscard]] LiveFeed& feed() { return feed_; }
    [[nodiscard]] std::string url() const { return server_.url(); }

    /// The run has ended and left this report.
    void finish(const std::filesystem::path& report);
    /// Gives a page that is open 5 s at most to fetch the report, on which it then lives on.
    void linger() const;

private:
    HttpAnswer answer(const std::string& path, const std::string& query);
    [[nodiscard]] std::string state() const;

    std::string name_, input_;
    std::size_t total_;
    LiveFeed feed_;
    std::shared_ptr<const std::string> page_, report_;  // report_: set once, before done_
    std::atomic<bool> done_{false}, fetched_{false};
    std::atomic<std::int64_t> asked_ms_{-1'000'000};  // when a page asked last
    HttpServer server_;                               // the last: its thread uses the others
};

}  // namespace dynamic_filter::app
