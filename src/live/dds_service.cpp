// SPDX-License-Identifier: MIT
#include "live/dds_service.hpp"

#include <array>
#include <memory>
#include <random>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "formats/byte_reader.hpp"
#include "live/dds_qos.hpp"
#include "live/dds_type.hpp"

namespace dynamic_filter::live {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr Quality kOfServices{.reliable = true, .latched = false, .depth = 10};  // as in ROS 2

/// The beginning of each request, and of its answer.
struct Caller {
    std::uint64_t client = 0;
    std::int64_t request = 0;
    bool operator==(const Caller&) const = default;
};

Caller read_caller(io::MessageReader& in) {
    const auto client = in.number<std::uint64_t>();
    return {.client = client, .request = in.number<std::int64_t>()};
}

void write(io::MessageWriter& out, const Caller& caller) {
    out.number(caller.client);
    out.number(caller.request);
}

Bytes moved_bytes(io::MessageWriter& out) {
    return std::make_shared<const std::vector<std::byte>>(out.moved_bytes());
}

/// "/filter/reset" and "std_srvs/Trigger" become, for requests, "rq/filter/resetRequest" of the
/// type "std_srvs::srv::dds_::Trigger_Request_"; answers are "rr/filter/resetReply".
dds_entity_t topic_of(dds_entity_t participant, const std::string& name, const ServiceType& type,
                      bool is_request) {
    const std::size_t slash = type.name.find('/');
    const std::string topic = is_request ? "rq" + name + "Request" : "rr" + name + "Reply";
    const std::string types = std::string(type.name.substr(0, slash)) +
                              "::srv::dds_::" + std::string(type.name.substr(slash + 1)) +
                              (is_request ? "_Request_" : "_Response_");
    const dds_entity_t entity = create_topic_of_bytes(participant, topic, types);
    require(entity, "service " + name);
    return entity;
}

dds_entity_t reader_of(dds_entity_t participant, dds_entity_t topic) {
    const dds_entity_t reader =
        dds_create_reader(participant, topic, qos_of_reader(kOfServices).get(), nullptr);
    require(reader, "cannot receive what services say");
    return reader;
}

dds_entity_t writer_of(dds_entity_t participant, dds_entity_t topic) {
    const dds_entity_t writer =
        dds_create_writer(participant, topic, qos_of_writer(kOfServices).get(), nullptr);
    require(writer, "cannot send what services say");
    return writer;
}

/// Wakes up when the reader has a message.
dds_entity_t waitset_for(dds_entity_t participant, dds_entity_t reader) {
    const dds_entity_t waitset = dds_create_waitset(participant);
    const dds_entity_t condition = dds_create_readcondition(reader, DDS_ANY_STATE);
    require(dds_waitset_attach(waitset, condition, reader), "cannot wait for messages");
    return waitset;
}

std::uint32_t readers_of(dds_entity_t writer) {
    dds_publication_matched_status_t status{};
    return dds_get_publication_matched_status(writer, &status) == 0 ? status.current_count : 0;
}

std::uint32_t writers_to(dds_entity_t reader) {
    dds_subscription_matched_status_t status{};
    return dds_get_subscription_matched_status(reader, &status) == 0 ? status.current_count : 0;
}

/// False if the condition does not hold in time.
template <class Condition>
bool wait_until(const Condition& holds, milliseconds patience) {
    const auto end = steady_clock::now() + patience;
    while (!holds()) {
        if (steady_clock::now() >= end) return false;
        std::this_thread::sleep_for(milliseconds(5));
    }
    return true;
}

bool is_for(const Caller& caller, const Bytes& message) {
    try {
        io::MessageReader in(*message, io::MessageEncoding::cdr);
        return read_caller(in) == caller;
    } catch (const io::Malformed&) {
        return false;
    }
}

/// What a client holds while it calls; goes with it.
struct Call {
    std::array<dds_entity_t, 5> entities{};  // in the order in which they are made

    Call() = default;
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;
    ~Call() {
        for (auto entity = entities.rbegin(); entity != entities.rend(); ++entity) {
            if (*entity > 0) dds_delete(*entity);
        }
    }
};

}  // namespace

DdsService::DdsService(dds_entity_t participant, const std::string& name, const ServiceType& type,
                       Serve serve)
    : serve_(std::move(serve)),
      requests_(reader_of(participant, topic_of(participant, name, type, true))),
      answers_(writer_of(participant, topic_of(participant, name, type, false))),
      waitset_(waitset_for(participant, requests_)),
      stop_(dds_create_guardcondition(participant)) {
    require(dds_waitset_attach(waitset_, stop_, stop_), "cannot wait for messages");
    thread_ = std::thread([this] { run(); });
}

DdsService::~DdsService() { stop(); }

void DdsService::stop() {
    if (!thread_.joinable()) return;
    dds_set_guardcondition(stop_, true);
    thread_.join();
}

void DdsService::run() {
    while (true) {
        dds_waitset_wait(waitset_, nullptr, 0, DDS_SECS(1));
        bool is_stopped = false;
        dds_read_guardcondition(stop_, &is_stopped);
        if (is_stopped) return;
        if (const auto message = pop_bytes(requests_)) answer(*message);
    }
}

void DdsService::answer(const Bytes& message) {
    try {
        io::MessageReader in(*message, io::MessageEncoding::cdr);
        io::MessageWriter out(io::MessageEncoding::cdr);
        write(out, read_caller(in));
        serve_(in, out);
        wait_for_client();
        write_bytes(answers_, moved_bytes(out));
    } catch (const io::Malformed&) {  // a request of another type gets no answer
    }
}

/// A client's reader may be discovered later than its writer; a message that is written before is
/// lost.
void DdsService::wait_for_client() const {
    wait_until([&] { return readers_of(answers_) >= writers_to(requests_); }, milliseconds(1000));
}

Bytes call_service(dds_entity_t participant, const std::string& name, const ServiceType& type,
                   const WriteRequest& write_request, const Patience& patience) {
    Call call;
    auto& [asked, answered, writer, reader, waitset] = call.entities;
    asked = topic_of(participant, name, type, true);
    answered = topic_of(participant, name, type, false);
    writer = writer_of(participant, asked);
    reader = reader_of(participant, answered);
    waitset = waitset_for(participant, reader);
    const auto is_offered = [&] { return readers_of(writer) > 0 && writers_to(reader) > 0; };
    if (!wait_until(is_offered, patience.for_service)) {
        throw Error("nobody offers the service " + name + "; is the filter running?");
    }
    std::random_device random;
    const Caller caller{.client = std::uint64_t{random()} << 32 | random(), .request = 1};
    io::MessageWriter out(io::MessageEncoding::cdr);
    write(out, caller);
    write_request(out);
    require(write_bytes(writer, moved_bytes(out)), "cannot call " + name);
    const auto end = steady_clock::now() + patience.for_answer;
    while (steady_clock::now() < end) {
        dds_waitset_wait(waitset, nullptr, 0, DDS_MSECS(200));
        const auto message = pop_bytes(reader);
        if (message && is_for(caller, *message)) return *message;
    }
    throw Error("the service " + name + " does not answer");
}

io::MessageReader read_dds_answer(const Bytes& message) {
    io::MessageReader in(*message, io::MessageEncoding::cdr);
    read_caller(in);
    return in;
}

}  // namespace dynamic_filter::live
