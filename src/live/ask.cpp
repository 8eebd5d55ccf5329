// SPDX-License-Identifier: MIT
#include "live/ask.hpp"

#include "dynamic_filter/error.hpp"
#include "live/requests.hpp"

namespace dynamic_filter::live {

namespace {

using std::chrono::minutes;
using std::chrono::seconds;

constexpr Patience kPatience{.for_service = seconds(5), .for_answer = minutes(5)};

ServiceAnswer call(DdsBus& bus, const std::string& name, const ServiceType& type,
                   const WriteRequest& write) {
    const Bytes answer = bus.call(name, type, write, kPatience);
    io::MessageReader in = read_dds_answer(answer);
    return read_answer(in);
}

/// Answers as that of /save_map.
ServiceAnswer save_as(DdsBus& bus, const std::string& service, const std::string& name) {
    const auto write = [&](io::MessageWriter& out) {
        out.text(name);
        out.text("");  // the format is that of the name
    };
    const Bytes answer = bus.call(service, kSaveMap, write, kPatience);
    io::MessageReader in = read_dds_answer(answer);
    const auto [success, message] = read_answer(in);
    Saved saved{.is_saved = success, .text = message, .file = in.text()};
    saved.points = in.number<std::uint64_t>();
    saved.bytes = in.number<std::uint64_t>();
    return {.success = success, .message = answer_text(saved)};
}

}  // namespace

ServiceAnswer ask(DdsBus& bus, const std::string& prefix, const std::string& request) {
    constexpr std::string_view kSaveAs = "save=";
    const RequestTopics topics(prefix, bus.encoding());
    const auto nothing = [](io::MessageWriter&) {};
    if (request == "save") return call(bus, topics.save.name, kTrigger, nothing);
    if (request.starts_with(kSaveAs) && request.size() > kSaveAs.size()) {
        return save_as(bus, topics.save_as.name, request.substr(kSaveAs.size()));
    }
    if (request == "reset") return call(bus, topics.reset.name, kTrigger, nothing);
    if (request == "pause" || request == "resume") {
        return call(bus, topics.pause.name, kSetBool, [&](io::MessageWriter& out) {
            out.number(static_cast<std::uint8_t>(request == "pause" ? 1 : 0));
        });
    }
    throw ConfigError("--ask " + request +
                      ": expected save, save=NAME (such as save=hall.ply), reset, pause or resume");
}

}  // namespace dynamic_filter::live
