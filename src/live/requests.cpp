// SPDX-License-Identifier: MIT
#include "live/requests.hpp"

#include <nlohmann/json.hpp>

#include "formats/byte_reader.hpp"
#include "formats/messages/message_reader.hpp"
#include "formats/messages/message_writer.hpp"

namespace dynamic_filter::live {

namespace {

using Json = nlohmann::ordered_json;

constexpr Quality kRequest{.reliable = true, .latched = false, .depth = 5};
constexpr Quality kAnswer{.reliable = true, .latched = true, .depth = 1};

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Bytes text_message(const std::string& text, io::MessageEncoding encoding) {
    io::MessageWriter out(encoding);
    out.text(text);
    return std::make_shared<const std::vector<std::byte>>(out.moved_bytes());
}

}  // namespace

RequestTopics::RequestTopics(const std::string& prefix, io::MessageEncoding encoding)
    : save{prefix + "/save_map", "std_msgs/Empty", encoding},
      save_as{prefix + "/save_map_as", "std_msgs/String", encoding},
      saved{prefix + "/saved_map", "std_msgs/String", encoding},
      reset{prefix + "/reset", "std_msgs/Empty", encoding},
      pause{prefix + "/pause", "std_msgs/Bool", encoding},
      state{prefix + "/state", "std_msgs/String", encoding} {}

std::string answer_text(const Saved& saved) {
    Json json{{"saved", saved.is_saved}};
    if (saved.is_saved) {
        json["file"] = std::filesystem::absolute(saved.file).string();
        json["points"] = saved.points;
        json["bytes"] = saved.bytes;
    } else {
        json["why"] = saved.text;
    }
    return text_of(json);
}

Requests::Requests(Bus& bus, const std::string& prefix, MapSaver* saver)
    : bus_(bus), topics_(prefix, bus.encoding()) {
    bus.advertise(topics_.saved, kAnswer);
    bus.advertise(topics_.state, kAnswer);
    const auto receive = [&](const io::Topic& topic, const auto& use) {
        bus.subscribe(topic, kRequest, [use](const io::Topic& from, const Bytes& message) {
            try {
                io::MessageReader in(*message, from.encoding);
                use(in);
            } catch (const io::Malformed&) {  // asks for nothing
            }
        });
    };
    receive(topics_.save, [this, saver](io::MessageReader&) { ask_to_save(saver, ""); });
    receive(topics_.save_as,
            [this, saver](io::MessageReader& in) { ask_to_save(saver, in.text()); });
    receive(topics_.reset, [this](io::MessageReader&) {
        is_reset_ = true;
        ++resets_;
        tell_state();
    });
    receive(topics_.pause, [this](io::MessageReader& in) {
        is_paused_ = in.number<std::uint8_t>() != 0;
        tell_state();
    });
    tell_state();
}

void Requests::ask_to_save(MapSaver* saver, const std::string& name) {
    const std::string fault = saver == nullptr ? "the filter was started without --map FILE"
                              : name.empty()   ? ""
                                               : saver->fault_of(name);
    if (!fault.empty()) return answer({.is_saved = false, .text = fault});
    saver->request(name);
}

void Requests::answer(const Saved& saved) {
    bus_.publish(topics_.saved.name, seconds_since_epoch(),
                 text_message(answer_text(saved), bus_.encoding()));
}

void Requests::tell_state() {
    const Json state{{"paused", is_paused_.load()}, {"resets", resets_.load()}};
    bus_.publish(topics_.state.name, seconds_since_epoch(),
                 text_message(text_of(state), bus_.encoding()));
}

}  // namespace dynamic_filter::live
