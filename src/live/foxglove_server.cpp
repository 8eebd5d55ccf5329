// SPDX-License-Identifier: MIT
#include "live/foxglove_server.hpp"

#include <fmt/format.h>
#include <libwebsockets.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <set>
#include <thread>
#include <utility>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/messages/definitions.hpp"
#include "live/foxglove_handshake.hpp"
#include "live/foxglove_protocol.hpp"
#include "live/foxglove_queue.hpp"
#include "page/listener.hpp"

namespace dynamic_filter::live {

namespace {

constexpr std::size_t kLongestRequest = 65536;  // [bytes] of a client's message
constexpr std::size_t kFragment = 65536;        // [bytes] that are sent at a time
constexpr std::size_t kTurn = 16 * kFragment;   // [bytes] for a client before it is others' turn
constexpr std::size_t kMostTexts = 16;          // that wait before statuses are left out
constexpr std::size_t kMostStrangers = 16;      // web pages that are reported
constexpr std::size_t kMostHandshakes = 32;     // at a time
constexpr int kHandshakeSeconds = 5;

std::string new_session() {
    std::random_device random;
    return fmt::format("{:08x}{:08x}", random(), random());
}

}  // namespace

/// libwebsockets polls all sockets. The listener, and connections until their handshake has come,
/// are files to it; what is accepted is then given to it as a connection.
struct FoxgloveServer::Engine {
    struct Channel {
        FoxgloveChannel described;
        Quality quality;
        Bytes last;                  // if latched
        std::int64_t last_time = 0;  // [ns]
    };
    struct Client {
        explicit Client(std::size_t most_bytes) : queue(most_bytes) {}
        // Guarded by the lock:
        FoxgloveQueue queue;
        std::map<std::uint32_t, std::uint32_t> subscriptions;  // keys: channels
        // Only for the service thread:
        std::string request;  // what has come of it
        std::optional<Outgoing> sending;
        std::size_t sent = 0;
        bool is_leaving = false;
    };
    struct Handshaking {
        int socket;
        std::uint64_t number;  // counts up
        std::string head{};
    };
    struct Accepted {
        int socket;
        std::string request;
    };

    Engine(io::MessageEncoding of_messages, const FoxgloveOptions& given)
        : encoding(of_messages), options(given) {}
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    ~Engine();

    io::MessageEncoding encoding;
    FoxgloveOptions options;
    std::string session = new_session();
    std::uint16_t port = 0;
    lws_context* context = nullptr;
    lws_vhost* host = nullptr;
    std::thread thread;
    std::atomic<bool> stopped = false;

    mutable std::mutex lock;                  // guards:
    std::map<std::string, Channel> channels;  // keys: names of topics
    std::map<lws*, Client> clients;           // only the service thread adds and removes
    std::set<std::string> strangers;          // web pages that were refused
    std::vector<std::string> notices;

    // Only for the service thread:
    int listener = -1;         // libwebsockets closes it
    lws* listening = nullptr;  // the same to libwebsockets
    std::map<lws*, Handshaking> handshakes;
    std::uint64_t accepted_count = 0;
    std::vector<Accepted> accepted;
    std::vector<unsigned char> fragment = std::vector<unsigned char>(LWS_PRE + kFragment);

    void open();
    void run();
    void adopt_accepted();
    lws* adopt_file(int file);

    static int on_file(lws*, lws_callback_reasons, void*, void*, std::size_t);
    static int on_websocket(lws*, lws_callback_reasons, void*, void*, std::size_t);
    int handle_websocket(lws*, lws_callback_reasons, const void* bytes, std::size_t size);

    void accept_some();
    void give_up_oldest_handshake();
    bool read_handshake(lws* wsi);
    Handshake judge(const std::string& head);

    void add_client(lws* wsi);
    void remove_client(lws* wsi);
    bool receive(lws* wsi, std::string_view bytes);
    void answer(Client& client, const FoxgloveRequest& request);
    void subscribe(Client& client, std::uint32_t id, std::uint32_t channel);
    void unsubscribe(Client& client, std::uint32_t id);
    bool send(lws* wsi);
    bool send_fragment(lws* wsi, Client& client);
    void wake_writers();

    [[nodiscard]] std::vector<FoxgloveChannel> described() const;
};

namespace {

void say(FoxgloveQueue& queue, FoxgloveLevel level, const std::string& message) {
    if (queue.texts() < kMostTexts) queue.put_text(status(level, message));
}

void set(int socket, int level, int option, int value) {
    setsockopt(socket, level, option, &value, sizeof value);
}

/// The connection ends if the client vanishes, and keeps little of what is sent in the system,
/// where it gets old.
void limit(int client) {
    constexpr int kUnsent = 256 << 10, kGoneMs = 60000, kIdleSeconds = 20;
    set(client, IPPROTO_TCP, TCP_NODELAY, 1);
    set(client, IPPROTO_TCP, TCP_NOTSENT_LOWAT, kUnsent);
    set(client, IPPROTO_TCP, TCP_USER_TIMEOUT, kGoneMs);
    set(client, IPPROTO_TCP, TCP_KEEPIDLE, kIdleSeconds);
    set(client, SOL_SOCKET, SO_KEEPALIVE, 1);
}

/// It is short, so that a new connection takes it at once.
void send_refusal(int socket, const std::string& response) {
    [[maybe_unused]] const auto sent =
        ::send(socket, response.data(), response.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    shutdown(socket, SHUT_WR);
}

}  // namespace

void FoxgloveServer::Engine::open() {
    listener = app::listen_at(options.address, options.port, "foxglove.port");
    port = app::port_of(listener);
    lws_set_log_level(0, nullptr);  // its messages are for its developers
    static const lws_protocols kProtocols[] = {
        {"file", on_file, 0, 0, 0, nullptr, 0},
        {kFoxgloveProtocols[0].data(), on_websocket, 0, 4096, 0, nullptr, kFragment + LWS_PRE},
        {kFoxgloveProtocols[1].data(), on_websocket, 0, 4096, 0, nullptr, kFragment + LWS_PRE},
        {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
    lws_context_creation_info info{};
    info.port = CONTEXT_PORT_NO_LISTEN_SERVER;
    info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
    info.protocols = kProtocols;
    info.user = this;
    // Its tables are as large as this, or as the number of files that the system allows.
    info.fd_limit_per_thread = static_cast<unsigned>(options.clients + 4 * kMostHandshakes);
    context = lws_create_context(&info);
    host = context == nullptr ? nullptr : lws_create_vhost(context, &info);
    if (host == nullptr) close(listener);
    listening = host == nullptr ? nullptr : adopt_file(listener);
    if (listening == nullptr) {
        throw OutputError(app::address_text(options.address, port),
                          "cannot listen: libwebsockets does not start; is there memory left?");
    }
    thread = std::thread([this] { run(); });
}

FoxgloveServer::Engine::~Engine() {
    stopped = true;
    if (thread.joinable()) {
        lws_cancel_service(context);
        thread.join();
    }
    for (const auto& [socket, request] : accepted) close(socket);
    if (context != nullptr) lws_context_destroy(context);
}

/// Has libwebsockets poll a file, and close it in the end. Nullptr if it cannot; then it is closed.
lws* FoxgloveServer::Engine::adopt_file(int file) {
    lws_sock_file_fd_type adopted{};
    adopted.filefd = file;
    return lws_adopt_descriptor_vhost(host, LWS_ADOPT_RAW_FILE_DESC, adopted, "file", nullptr);
}

void FoxgloveServer::Engine::run() {
    while (!stopped && lws_service(context, 0) >= 0) adopt_accepted();
}

/// Here rather than where they were accepted, because libwebsockets is not within a call then.
void FoxgloveServer::Engine::adopt_accepted() {
    for (const Accepted& client : std::exchange(accepted, {})) {
        lws_adopt_socket_vhost_readbuf(host, client.socket, client.request.data(),
                                       client.request.size());
    }
}

int FoxgloveServer::Engine::on_file(lws* wsi, lws_callback_reasons reason, void*, void*,
                                    std::size_t) {
    auto& engine = *static_cast<Engine*>(lws_context_user(lws_get_context(wsi)));
    try {
        switch (reason) {
            case LWS_CALLBACK_RAW_RX_FILE:
                if (engine.handshakes.contains(wsi)) return engine.read_handshake(wsi) ? 0 : -1;
                if (wsi != engine.listening) return -1;  // it gave way
                engine.accept_some();
                return 0;
            case LWS_CALLBACK_RAW_CLOSE_FILE:
                engine.handshakes.erase(wsi);
                return 0;
            case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
                engine.wake_writers();
                return 0;
            default:
                return 0;
        }
    } catch (const std::exception&) {  // must not pass through libwebsockets
        return -1;
    }
}

/// Where too many have not asked yet, the one that has had most time for it gives way, so that
/// connections that say nothing keep nobody out.
void FoxgloveServer::Engine::accept_some() {
    // Those that give way are closed only after this call; libwebsockets has no table for more.
    for (std::size_t i = 0; i < kMostHandshakes; ++i) {
        const int socket = app::accept_at(listener);
        if (socket < 0) return;
        limit(socket);
        if (handshakes.size() >= kMostHandshakes) give_up_oldest_handshake();
        lws* const wsi = adopt_file(socket);
        if (wsi == nullptr) continue;
        handshakes.emplace(wsi, Handshaking{socket, ++accepted_count});
        lws_set_timeout(wsi, PENDING_TIMEOUT_USER_OK, kHandshakeSeconds);
    }
}

void FoxgloveServer::Engine::give_up_oldest_handshake() {
    const auto oldest = std::ranges::min_element(
        handshakes, {}, [](const auto& entry) { return entry.second.number; });
    lws* const wsi = oldest->first;
    handshakes.erase(oldest);
    lws_set_timeout(wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
}

/// False to close the file; an accepted connection goes on with a copy of it.
bool FoxgloveServer::Engine::read_handshake(lws* wsi) {
    Handshaking& client = handshakes.at(wsi);
    std::array<char, 4096> bytes;
    const ssize_t count = recv(client.socket, bytes.data(), bytes.size(), 0);
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    if (count == 0) return false;
    client.head.append(bytes.data(), static_cast<std::size_t>(count));
    const std::size_t end = client.head.find("\r\n\r\n");
    if (end == std::string::npos && client.head.size() <= kLongestHandshake) return true;
    const Handshake result = end == std::string::npos ? refused(431, "the request is too long")
                             : end + 4 < client.head.size()
                                 ? refused(400, "expected nothing more before the answer")
                                 : judge(client.head);
    if (result.request.empty()) {
        send_refusal(client.socket, result.refusal);
        return false;
    }
    const int copy = dup(client.socket);
    if (copy >= 0) accepted.push_back({copy, result.request});
    return false;
}

Handshake FoxgloveServer::Engine::judge(const std::string& head) {
    Handshake result = judge_handshake(head, options.origins);
    const std::lock_guard hold(lock);
    if (!result.origin.empty() && strangers.size() < kMostStrangers &&
        strangers.insert(result.origin).second) {
        notices.push_back(
            fmt::format("a web page of {} wanted to read what Foxglove is sent, and was refused; "
                        "if it is yours, allow its origin",
                        result.origin));
    }
    if (!result.request.empty() && clients.size() + accepted.size() >= options.clients) {
        return refused(503, "too many clients");
    }
    return result;
}

int FoxgloveServer::Engine::on_websocket(lws* wsi, lws_callback_reasons reason, void*, void* in,
                                         std::size_t size) {
    auto& engine = *static_cast<Engine*>(lws_context_user(lws_get_context(wsi)));
    try {
        return engine.handle_websocket(wsi, reason, in, size);
    } catch (const std::exception&) {  // must not pass through libwebsockets
        return -1;
    }
}

int FoxgloveServer::Engine::handle_websocket(lws* wsi, lws_callback_reasons reason,
                                             const void* bytes, std::size_t size) {
    switch (reason) {
        case LWS_CALLBACK_ESTABLISHED:
            add_client(wsi);
            return 0;
        case LWS_CALLBACK_RECEIVE:
            return receive(wsi, {static_cast<const char*>(bytes), size}) ? 0 : -1;
        case LWS_CALLBACK_SERVER_WRITEABLE:
            return send(wsi) ? 0 : -1;
        case LWS_CALLBACK_CLOSED:
            remove_client(wsi);
            return 0;
        default:
            return 0;
    }
}

std::vector<FoxgloveChannel> FoxgloveServer::Engine::described() const {
    std::vector<FoxgloveChannel> list;
    for (const auto& [name, channel] : channels) list.push_back(channel.described);
    return list;
}

void FoxgloveServer::Engine::add_client(lws* wsi) {
    const std::lock_guard hold(lock);
    Client& client = clients.try_emplace(wsi, options.client_bytes).first->second;
    client.queue.put_text(server_info(session));
    client.queue.put_text(advertisement(described()));
    lws_callback_on_writable(wsi);
}

void FoxgloveServer::Engine::remove_client(lws* wsi) {
    const std::lock_guard hold(lock);
    clients.erase(wsi);
}

/// Takes a part of a message. False to close the connection.
bool FoxgloveServer::Engine::receive(lws* wsi, std::string_view bytes) {
    Client& client = clients.at(wsi);
    if (client.is_leaving) return true;
    if (lws_is_first_fragment(wsi) != 0) client.request.clear();
    if (client.request.size() + bytes.size() + lws_remaining_packet_payload(wsi) >
        kLongestRequest) {
        client.is_leaving = true;  // its answer is awaited for some seconds
        const std::lock_guard hold(lock);
        client.subscriptions.clear();
        client.queue.clear();
        lws_close_reason(wsi, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, nullptr, 0);
        return false;
    }
    client.request += bytes;
    if (lws_is_final_fragment(wsi) == 0) return true;
    FoxgloveRequest request;
    if (lws_frame_is_binary(wsi) != 0) {
        request.unsupported = "binary message";
    } else {
        request = parse_request(client.request);
    }
    const std::lock_guard hold(lock);
    answer(client, request);
    if (!client.queue.empty()) lws_callback_on_writable(wsi);
    return true;
}

void FoxgloveServer::Engine::answer(Client& client, const FoxgloveRequest& request) {
    if (!request.wrong.empty()) say(client.queue, FoxgloveLevel::error, request.wrong);
    if (!request.unsupported.empty()) {
        say(client.queue, FoxgloveLevel::warning,
            request.unsupported + ": not done here; this server can only be read");
    }
    for (const auto& [id, channel] : request.subscribe) subscribe(client, id, channel);
    for (const std::uint32_t id : request.unsubscribe) unsubscribe(client, id);
}

void FoxgloveServer::Engine::subscribe(Client& client, std::uint32_t id, std::uint32_t channel) {
    const auto found = std::find_if(channels.begin(), channels.end(), [&](const auto& entry) {
        return entry.second.described.id == channel;
    });
    const bool id_is_used =
        std::any_of(client.subscriptions.begin(), client.subscriptions.end(),
                    [&](const auto& subscription) { return subscription.second == id; });
    if (found == channels.end() || id_is_used || client.subscriptions.contains(channel)) {
        return say(client.queue, FoxgloveLevel::error,
                   fmt::format("cannot subscribe to channel {} as {}: {}", channel, id,
                               found == channels.end() ? "there is no such channel"
                               : id_is_used            ? "the subscription's id is in use"
                                                       : "it is subscribed already"));
    }
    client.subscriptions.emplace(channel, id);
    const Channel& of = found->second;
    if (of.last) {
        client.queue.put_message({message_head(id, of.last_time), of.last, id}, of.quality.depth);
    }
}

void FoxgloveServer::Engine::unsubscribe(Client& client, std::uint32_t id) {
    const auto erased =
        std::erase_if(client.subscriptions, [&](const auto& entry) { return entry.second == id; });
    client.queue.forget(id);
    if (erased == 0) {
        say(client.queue, FoxgloveLevel::warning, fmt::format("there is no subscription {}", id));
    }
}

void FoxgloveServer::Engine::wake_writers() {
    const std::lock_guard hold(lock);
    for (const auto& [wsi, client] : clients) {
        if (!client.queue.empty()) lws_callback_on_writable(wsi);
    }
}

/// Sends until nothing waits, the client takes no more, or it is others' turn. False to close.
bool FoxgloveServer::Engine::send(lws* wsi) {
    Client& client = clients.at(wsi);
    for (std::size_t turn = 0; turn < kTurn && !client.is_leaving; turn += kFragment) {
        if (!client.sending) {
            const std::lock_guard hold(lock);
            client.sending = client.queue.pop();
            client.sent = 0;
        }
        if (!client.sending) return true;
        if (!send_fragment(wsi, client)) return false;
        if (lws_send_pipe_choked(wsi) != 0) break;
    }
    lws_callback_on_writable(wsi);
    return true;
}

/// Large messages are sent in fragments, because libwebsockets would copy what does not fit into
/// the socket's buffer.
bool FoxgloveServer::Engine::send_fragment(lws* wsi, Client& client) {
    const auto& [head, body, subscription] = *client.sending;
    const std::size_t all = head.size() + (body ? body->size() : 0);
    const std::size_t first = client.sent, last = std::min(all, first + kFragment);
    unsigned char* const to = fragment.data() + LWS_PRE;
    const std::size_t from_head = std::min(head.size(), last) - std::min(head.size(), first);
    if (from_head > 0) std::memcpy(to, head.data() + first, from_head);
    if (last - first > from_head) {
        std::memcpy(to + from_head, body->data() + (first + from_head - head.size()),
                    last - first - from_head);
    }
    const int kind = first > 0 ? LWS_WRITE_CONTINUATION : body ? LWS_WRITE_BINARY : LWS_WRITE_TEXT;
    const int flags = kind | (last < all ? LWS_WRITE_NO_FIN : 0);
    if (lws_write(wsi, to, last - first, static_cast<lws_write_protocol>(flags)) < 0) return false;
    client.sent = last;
    if (last == all) client.sending.reset();
    return true;
}

FoxgloveServer::FoxgloveServer(io::MessageEncoding encoding, const FoxgloveOptions& options)
    : engine_(std::make_unique<Engine>(encoding, options)) {
    engine_->open();
}

FoxgloveServer::~FoxgloveServer() = default;

void FoxgloveServer::advertise(const io::Topic& topic, const Quality& quality) {
    const io::Topic sent{topic.name, topic.type, engine_->encoding};
    if (io::full_definition(sent.type, sent.encoding).empty()) {
        throw Error(fmt::format("cannot show {}: the definition of {} is not known", topic.name,
                                topic.type));
    }
    {
        const std::lock_guard hold(engine_->lock);
        const auto id = static_cast<std::uint32_t>(engine_->channels.size() + 1);
        const auto [it, fresh] = engine_->channels.try_emplace(topic.name);
        Engine::Channel& channel = it->second;
        if (fresh) channel.described = {id, sent};
        if (channel.described.topic != sent) {
            throw Error(fmt::format("{} is {} for Foxglove already, and cannot become {}",
                                    topic.name, channel.described.topic.type, topic.type));
        }
        channel.quality = quality;
        if (!fresh) return;
        const std::string text = advertisement({channel.described});
        for (auto& [wsi, client] : engine_->clients) client.queue.put_text(text);
    }
    lws_cancel_service(engine_->context);
}

bool FoxgloveServer::is_wanted(const std::string& topic) const {
    const std::lock_guard hold(engine_->lock);
    const auto channel = engine_->channels.find(topic);
    return channel != engine_->channels.end() &&
           std::any_of(engine_->clients.begin(), engine_->clients.end(), [&](const auto& entry) {
               return entry.second.subscriptions.contains(channel->second.described.id);
           });
}

bool FoxgloveServer::publish(const std::string& topic, double stamp, const Bytes& message) {
    const std::int64_t time = io::to_nanoseconds(stamp);
    bool all_took_it = true;
    {
        const std::lock_guard hold(engine_->lock);
        const auto found = engine_->channels.find(topic);
        if (found == engine_->channels.end()) return false;
        auto& [described, quality, last, last_time] = found->second;
        if (quality.latched) {
            last = message;
            last_time = time;
        }
        for (auto& [wsi, client] : engine_->clients) {
            const auto subscription = client.subscriptions.find(described.id);
            if (subscription == client.subscriptions.end()) continue;
            const std::uint32_t id = subscription->second;
            all_took_it &=
                client.queue.put_message({message_head(id, time), message, id}, quality.depth);
        }
    }
    lws_cancel_service(engine_->context);
    return all_took_it;
}

std::vector<std::string> FoxgloveServer::pop_notices() {
    const std::lock_guard hold(engine_->lock);
    return std::exchange(engine_->notices, {});
}

std::uint16_t FoxgloveServer::port() const { return engine_->port; }

std::string FoxgloveServer::url() const {
    return "ws://" + app::address_text(engine_->options.address, engine_->port);
}

std::size_t FoxgloveServer::clients() const {
    const std::lock_guard hold(engine_->lock);
    return engine_->clients.size();
}

}  // namespace dynamic_filter::live
