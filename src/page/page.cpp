// SPDX-License-Identifier: MIT
#include "page/page.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::app {

namespace {

constexpr std::string_view kMarker = "<!--DATA-->", kEnd = "<!--END OF DATA-->";

std::string gzip(const std::string& bytes) {
    constexpr int kLevel = 1, kGzip = 15 + 16, kMemory = 8;
    z_stream stream{};
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::bad_alloc();
    }
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    std::string in = bytes;  // zlib's interface is not const
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

std::string base64(const std::string& bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
            three = three << 8U | byte;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const bool padding = i + k > bytes.size();
            text += padding ? '=' : kDigits[three >> (18 - 6 * k) & 63U];
        }
    }
    return text;
}

/// No string in it can end the tag around it.
std::string safe_json(const nlohmann::ordered_json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

constexpr std::string_view kFirstTag = "<script type=\"application/json\" id=\"run-0\">";
constexpr std::string_view kFirstId = "id=\"run-0";

/// Where the data go. Throws Error if there is no page.
std::size_t marker_of(std::string_view page) {
    const std::size_t at = page.find(kMarker);
    if (at != std::string_view::npos) return at;
    throw Error("this command was built without the viewer; run script/bootstrap and script/build");
}

/// Takes the contents of the first such element out of the page, and puts `instead` for the whole
/// element.
std::string replace_element(std::string& page, const std::string& tag, const std::string& instead) {
    const std::string open = "<" + tag + ">", close = "</" + tag + ">";
    const std::size_t begin = page.find(open), end = page.find(close, begin);
    if (begin == std::string::npos || end == std::string::npos)
        throw Error("the viewer has no <" + tag + ">; run script/build again");
    std::string contents = page.substr(begin + open.size(), end - begin - open.size());
    page.replace(begin, end + close.size() - begin, instead);
    return contents + "\n";
}

}  // namespace

std::string embedded(const PageRun& run, std::size_t number) {
    nlohmann::ordered_json info = run.info;
    info["arrays"] = nlohmann::ordered_json::object();
    for (const PageArray& a : run.arrays) {
        info["arrays"][a.name] = {{"type", a.type}, {"columns", a.columns}, {"rows", a.rows}};
    }
    std::vector<std::string> packed(run.arrays.size());
    parallel_for(packed.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) packed[i] = base64(gzip(run.arrays[i].bytes));
    });
    std::string text = fmt::format("<script type=\"application/json\" id=\"run-{}\">{}</script>\n",
                                   number, safe_json(info));
    for (std::size_t i = 0; i < packed.size(); ++i) {
        text += fmt::format("<script type=\"text/plain\" id=\"run-{}-{}\">{}</script>\n", number,
                            run.arrays[i].name, packed[i]);
    }
    return text;
}

std::string page_with(std::span<const std::string> runs) {
    const std::string_view page = viewer_page();
    const std::size_t at = marker_of(page);
    std::string text(page.substr(0, at + kMarker.size()));
    text += '\n';
    for (const std::string& run : runs) text += run;
    text += kEnd;
    return text += page.substr(at + kMarker.size());
}

SharedPage shared_page() {
    const std::string_view page = viewer_page();
    const std::size_t at = marker_of(page);
    SharedPage shared;
    shared.before = page.substr(0, at + kMarker.size());
    shared.after = page.substr(at + kMarker.size());
    shared.style =
        replace_element(shared.before, "style", "<link rel=\"stylesheet\" href=\"viewer.css\">");
    shared.script = replace_element(shared.after, "script", "<script src=\"viewer.js\"></script>");
    return shared;
}

std::string SharedPage::with(const std::string& run) const {
    std::string text = before + "\n" + run;
    return text.append(kEnd) + after;
}

std::string run_of_report(const std::filesystem::path& file, std::size_t number) {
    const std::string page = io::read_file(file);
    const std::size_t begin = page.find(kFirstTag), end = page.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin) {
        throw InputError(file, "",
                         "is no report of a run; expected the report.html that `run` leaves");
    }
    std::string run = page.substr(begin, end - begin);
    const std::string id = fmt::format("id=\"run-{}", number);
    for (std::size_t at = 0; (at = run.find(kFirstId, at)) != std::string::npos; at += id.size()) {
        run.replace(at, kFirstId.size(), id);
    }
    return run;
}

}  // namespace dynamic_filter::app
