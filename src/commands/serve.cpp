// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>
#include <thread>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/edit_server.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "page/http_server.hpp"

namespace dynamic_filter::app {

namespace {

struct ServeOptions {
    std::filesystem::path folder;
    std::uint16_t port = 0;
    bool edit = false;  ///< corrections by hand, of one run
};

namespace fs = std::filesystem;

/// The pages that are served, by their paths. Only pages that were there at the start are served.
using Pages = std::map<std::string, fs::path>;

Pages reports_in(const fs::path& folder) {
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

/// The pages of a map's tiles, and what they share, beside each report.
Pages tiles_beside(const Pages& reports) {
    Pages pages;
    for (const auto& [path, report] : reports) {
        const std::string folder = path.substr(0, path.rfind('/')) + "/report/";
        std::error_code none;
        for (const fs::directory_entry& entry :
             fs::directory_iterator(report.parent_path() / "report", none)) {
            const fs::path& file = entry.path();
            const bool is_page = file.extension() == ".html" || file.filename() == "viewer.js" ||
                                 file.filename() == "viewer.css";
            if (is_page && !entry.is_symlink()) pages[folder + file.filename().string()] = file;
        }
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

HttpAnswer file_of(const fs::path& file) {
    HttpAnswer answer = html(io::read_file(file));
    if (file.extension() == ".js") answer.type = "text/javascript; charset=utf-8";
    if (file.extension() == ".css") answer.type = "text/css; charset=utf-8";
    return answer;
}

/// One run is shown at once, several as a list.
HttpAnswer answer(const Pages& reports, const Pages& tiles, const std::string& path) {
    const auto page = path == "/" && reports.size() == 1 ? reports.begin() : reports.find(path);
    const auto tile = tiles.find(path);
    if (page == reports.end() && tile == tiles.end())
        return path == "/" ? html(list_of(reports)) : HttpAnswer{};
    try {
        return file_of(page != reports.end() ? page->second : tile->second);
    } catch (const InputError&) {
        return {};  // gone since
    }
}

}  // namespace

int serve(const ServeOptions& o) {
    std::optional<EditServer> editor;
    if (o.edit) editor.emplace(o.folder);
    const Pages reports = reports_in(o.folder), tiles = tiles_beside(reports);
    catch_interrupts();
    constexpr std::size_t kMostBytes = 64 << 20;  // of edits.json
    const auto handle = [&](const HttpRequest& request) {
        if (editor && EditServer::is_meant(request.path)) return editor->answer(request);
        return request.method == "POST" ? HttpAnswer{405, "text/plain", {}}
                                        : answer(reports, tiles, request.path);
    };
    const HttpServer server(o.port, handle, {.body_bytes = editor ? kMostBytes : 0});
    say("{} {} at {}{}   (Ctrl-C ends)\n", reports.size(), reports.size() == 1 ? "run" : "runs",
        server.url(), editor ? "?edit=" + editor->token() : "");
    std::fflush(stdout);
    while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return kDone;
}

void add_serve(Program& program) {
    Command c = program.command("serve", "Show reports in a browser, on this machine");
    const auto o = std::make_shared<ServeOptions>();
    c.path("DIR", o->folder, "output folder of a run, or a folder that holds several").required();
    c.whole("--port", o->port, {.high = 65535}, "port (default: any free one)");
    c.flag("--edit", o->edit,
           "correct the labels of this run by hand in the page; the corrections are kept in "
           "DIR/edits.json");
    c.action([o] { return serve(*o); });
}

}  // namespace dynamic_filter::app
