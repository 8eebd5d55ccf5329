// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>
#include <thread>

#include "commands.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/file.hpp"
#include "progress.hpp"
#include "view/edit_server.hpp"
#include "view/http_server.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// What can be asked for: only what was there at the start, by the paths made here.
using Pages = std::map<std::string, fs::path>;

Pages pages_in(const fs::path& folder) {
    if (fs::exists(folder / "report.html")) return {{"/report.html", folder / "report.html"}};
    Pages pages;
    std::error_code unreadable;
    for (const fs::directory_entry& run : fs::directory_iterator(folder, unreadable)) {
        const fs::path page = run.path() / "report.html";
        if (run.is_symlink() || !fs::exists(page)) continue;
        pages["/" + run.path().filename().string() + "/report.html"] = page;
    }
    if (pages.empty()) {
        throw InputError(folder, "",
                         "holds no report.html, nor do the folders in it; expected the output "
                         "folder of a run, which `dynamicfilter run RECORDING -o DIR` makes, or a "
                         "folder with several");
    }
    return pages;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '<':
                result += "&lt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string list_of(const Pages& pages) {
    std::string text =
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Runs</title>"
        "<style>:root{color-scheme:light dark}body{font:1rem system-ui;margin:2rem}"
        "li{margin:.5rem}</style><h1>Runs</h1><ul>";
    for (const auto& [path, file] : pages) {
        text += fmt::format("<li><a href=\"{}\">{}</a></li>", escaped(path),
                            escaped(file.parent_path().filename().string()));
    }
    return text + "</ul>\n";
}

HttpAnswer html(std::string text) {
    return {200, "text/html; charset=utf-8", std::make_shared<const std::string>(std::move(text))};
}

/// One run is shown at once, several as a list.
HttpAnswer answer(const Pages& pages, const std::string& path) {
    const auto page = path == "/" && pages.size() == 1 ? pages.begin() : pages.find(path);
    if (page == pages.end()) return path == "/" ? html(list_of(pages)) : HttpAnswer{};
    try {
        return html(io::read_file(page->second));
    } catch (const InputError&) {
        return {};  // gone since
    }
}

}  // namespace

int serve(const ServeOptions& o) {
    std::optional<EditServer> editor;
    if (o.edit) editor.emplace(o.folder);
    const Pages pages = pages_in(o.folder);
    catch_interrupts();
    constexpr std::size_t kMostBytes = 64 << 20;  // of edits.json
    const auto handle = [&](const HttpRequest& request) {
        if (editor && EditServer::is_meant(request.path)) return editor->answer(request);
        return request.method == "POST" ? HttpAnswer{405, "text/plain", {}}
                                        : answer(pages, request.path);
    };
    const HttpServer server(o.port, handle, {.body_bytes = editor ? kMostBytes : 0});
    fmt::print("{} {} at {}{}   (Ctrl-C ends)\n", pages.size(), pages.size() == 1 ? "run" : "runs",
               server.url(), editor ? "?edit=" + editor->token() : "");
    std::fflush(stdout);
    while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return kDone;
}

}  // namespace dynamic_filter::app
