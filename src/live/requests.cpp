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

/// Why the map cannot be saved; "" if it can.
std::string fault_of(const MapSaver* saver, const std::string& name) {
    if (saver == nullptr) return "the filter was started without --map FILE";
    return name.empty() ? "" : saver->fault_of(name);
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
    receive_messages(saver);
    offer_services(saver);
    tell_state();
}

void Requests::receive_messages(MapSaver* saver) {
    const auto receive = [&](const io::Topic& topic, const auto& use) {
        bus_.subscribe(topic, kRequest, [use](const io::Topic& from, const Bytes& message) {
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
    receive(topics_.reset, [this](io::MessageReader&) { reset(); });
    receive(topics_.pause,
            [this](io::MessageReader& in) { pause(in.number<std::uint8_t>() != 0); });
}

void Requests::offer_services(MapSaver* saver) {
    bus_.serve(topics_.save.name, kTrigger,
               [this, saver](io::MessageReader&, io::MessageWriter& out) {
                   const Saved saved = save_now(saver, "");
                   write(out, {.success = saved.is_saved, .message = answer_text(saved)});
               });
    bus_.serve(topics_.save_as.name, kSaveMap,
               [this, saver](io::MessageReader& in, io::MessageWriter& out) {
                   const std::string path = in.text(), format = in.text();
                   const Saved saved =
                       save_now(saver, saver == nullptr ? "" : saver->name_of(path, format));
                   write(out, {.success = saved.is_saved, .message = saved.text});
                   out.text(saved.is_saved ? std::filesystem::absolute(saved.file).string() : "");
                   out.number(saved.points);
                   out.number(saved.bytes);
               });
    bus_.serve(topics_.reset.name, kTrigger, [this](io::MessageReader&, io::MessageWriter& out) {
        reset();
        write(out, {.success = true, .message = state_text()});
    });
    bus_.serve(topics_.pause.name, kSetBool, [this](io::MessageReader& in, io::MessageWriter& out) {
        pause(in.number<std::uint8_t>() != 0);
        write(out, {.success = true, .message = state_text()});
    });
}

void Requests::reset() {
    is_reset_ = true;
    ++resets_;
    tell_state();
}

void Requests::pause(bool is_paused) {
    is_paused_ = is_paused;
    tell_state();
}

void Requests::ask_to_save(MapSaver* saver, const std::string& name) {
    const std::string fault = fault_of(saver, name);
    if (!fault.empty()) return answer({.is_saved = false, .text = fault});
    saver->request(name);
}

/// Waits until the map is written.
Saved Requests::save_now(MapSaver* saver, const std::string& name) {
    const std::string fault = fault_of(saver, name);
    if (!fault.empty()) return {.is_saved = false, .text = fault};
    const std::uint64_t number = saver->request(name);
    std::unique_lock hold(lock_);
    answered_.wait(hold, [&] { return has_ended_ || last_.request >= number; });
    return last_.request >= number ? last_ : Saved{.is_saved = false, .text = "the filter ends"};
}

void Requests::end() {
    const std::lock_guard hold(lock_);
    has_ended_ = true;
    answered_.notify_all();
}

void Requests::answer(const Saved& saved) {
    if (saved.request > 0) {
        const std::lock_guard hold(lock_);
        last_ = saved;
        answered_.notify_all();
    }
    bus_.publish(topics_.saved.name, seconds_since_epoch(),
                 text_message(answer_text(saved), bus_.encoding()));
}

std::string Requests::state_text() const {
    return text_of({{"paused", is_paused_.load()}, {"resets", resets_.load()}});
}

void Requests::tell_state() {
    bus_.publish(topics_.state.name, seconds_since_epoch(),
                 text_message(state_text(), bus_.encoding()));
}

}  // namespace dynamic_filter::live
