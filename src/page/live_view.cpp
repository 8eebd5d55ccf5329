// SPDX-License-Identifier: MIT
#include "page/live_view.hpp"

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "dynamic_filter/file.hpp"
#include "page/page.hpp"
#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

std::int64_t now_ms() {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

/// N of "after=N"; 0 if it is none.
std::uint32_t number_in(const std::string& query) {
    constexpr std::string_view kName = "after=";
    if (!query.starts_with(kName)) return 0;
    return static_cast<std::uint32_t>(std::strtoul(query.c_str() + kName.size(), nullptr, 10));
}

std::shared_ptr<const std::string> shared(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
}

}  // namespace

LiveView::LiveView(std::uint16_t port, std::string name, std::string input, std::size_t total)
    : name_(std::move(name)),
      input_(std::move(input)),
      total_(total),
      page_(shared(page_with({}))),
      server_(port,
              [this](const HttpRequest& request) { return answer(request.path, request.query); }) {}

void LiveView::finish(const std::filesystem::path& report) {
    if (std::filesystem::exists(report)) report_ = shared(io::read_file(report));
    done_ = true;
}

void LiveView::linger() const {
    constexpr std::int64_t kRecently = 2000, kLongest = 5000;
    const std::int64_t start = now_ms();
    const auto is_awaited = [&] { return !fetched_ && now_ms() - asked_ms_ < kRecently; };
    const auto is_being_sent = [&] { return report_.use_count() > 1; };  // a connection holds it
    while (report_ && (is_awaited() || is_being_sent()) && now_ms() - start < kLongest) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

std::string LiveView::state() const {
    return text_of({{"name", name_},
                    {"input", input_},
                    {"total", total_},
                    {"done", done_.load()},
                    {"newest", feed_.newest()},
                    {"version", DYNAMIC_FILTER_VERSION},
                    {"report", done_ && report_}});
}

HttpAnswer LiveView::answer(const std::string& path, const std::string& query) {
    if (path == "/") return {200, "text/html; charset=utf-8", page_};
    if (path == "/state") {
        asked_ms_ = now_ms();
        return {200, "application/json", shared(state())};
    }
    if (path == "/live") {
        return {200, "application/octet-stream", shared(feed_.after(number_in(query)))};
    }
    if (path == "/report.html" && done_ && report_) {
        fetched_ = true;
        return {200, "text/html; charset=utf-8", report_};
    }
    return {};
}

}  // namespace dynamic_filter::app
