// SPDX-License-Identifier: MIT
#include "live/save_requests.hpp"

#include <nlohmann/json.hpp>

#include "formats/messages/message_writer.hpp"

namespace dynamic_filter::live {

namespace {

constexpr Quality kRequest{.reliable = true, .latched = false, .depth = 5};
constexpr Quality kAnswer{.reliable = true, .latched = true, .depth = 1};

Bytes text_message(const std::string& text, io::MessageEncoding encoding) {
    io::MessageWriter out(encoding);
    out.text(text);
    return std::make_shared<const std::vector<std::byte>>(out.moved_bytes());
}

}  // namespace

SaveTopics::SaveTopics(const std::string& prefix, io::MessageEncoding encoding)
    : request{prefix + "/save_map", "std_msgs/Empty", encoding},
      answer{prefix + "/saved_map", "std_msgs/String", encoding} {}

std::string answer_text(const Saved& saved) {
    nlohmann::ordered_json json{{"saved", saved.is_saved}};
    if (saved.is_saved) {
        json["file"] = std::filesystem::absolute(saved.file).string();
        json["points"] = saved.points;
        json["bytes"] = saved.bytes;
    } else {
        json["why"] = saved.text;
    }
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

SaveRequests::SaveRequests(Bus& bus, const std::string& prefix, MapSaver* saver)
    : bus_(bus), topics_(prefix, bus.encoding()) {
    bus.advertise(topics_.answer, kAnswer);
    bus.subscribe(topics_.request, kRequest, [this, saver](const io::Topic&, const Bytes&) {
        if (saver) {
            saver->request();
        } else {
            answer({.is_saved = false, .text = "the filter was started without --map FILE"});
        }
    });
}

void SaveRequests::answer(const Saved& saved) {
    bus_.publish(topics_.answer.name, seconds_since_epoch(),
                 text_message(answer_text(saved), bus_.encoding()));
}

}  // namespace dynamic_filter::live
