// SPDX-License-Identifier: MIT
// Another implementation of DDS, eProsima's Fast DDS, at the other end of the wire:
//   fastdds_peer publish|relay|subscribe|decode OPTION=VALUE...
// publish sends count= messages of sizes=, a list with commas, at rate= per second, once match=
// subscribers are there, and prints the size and the FNV-1a hash of each; relay sends the messages
// of standard input, each behind its size in four bytes. subscribe prints the size and the hash of
// what it gets, decode the fields. All end with their standard input. See Options for the rest.

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "cdr_text.hpp"
#include "fastdds_options.hpp"

namespace dynamic_filter::peers {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

void say(const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
}

std::string size_and_hash(const Bytes& message) {
    std::uint64_t hash = 14695981039346656037U;
    for (const unsigned char byte : message) hash = (hash ^ byte) * 1099511628211U;
    std::ostringstream out;
    out << message.size() << ' ' << std::hex << hash;
    return out.str();
}

/// Random bytes behind a CDR header in little endian.
Bytes random_message(std::size_t size, unsigned seed) {
    std::minstd_rand random(seed);
    Bytes message(size);
    for (unsigned char& byte : message) byte = static_cast<unsigned char>(random() >> 8);
    for (std::size_t i = 0; i < 4; ++i) message[i] = i == 1 ? 1 : 0;
    return message;
}

/// True once standard input has ended, or after the time.
bool input_ended(int milliseconds) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, milliseconds) <= 0) return false;
    char ignored = 0;
    return read(STDIN_FILENO, &ignored, 1) <= 0;
}

void require(bool done, const char* what) {
    if (!done) throw std::runtime_error(std::string("cannot make ") + what);
}

class Listener final : public dds::DataReaderListener {
public:
    explicit Listener(std::string decoded_type) : type_(std::move(decoded_type)) {}

    void on_data_available(dds::DataReader* reader) override {
        Bytes message;
        dds::SampleInfo info;
        while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK) {
            if (info.valid_data)
                say("got " + (type_.empty() ? size_and_hash(message) : decoded(message)));
        }
    }
    void on_subscription_matched(dds::DataReader*,
                                 const dds::SubscriptionMatchedStatus& s) override {
        say("publishers " + std::to_string(s.current_count));
    }
    void on_requested_incompatible_qos(dds::DataReader*,
                                       const dds::RequestedIncompatibleQosStatus& s) override {
        say("incompatible " + std::to_string(s.last_policy_id));
    }

private:
    [[nodiscard]] std::string decoded(const Bytes& message) const {
        try {
            return text_of(type_, message);
        } catch (const std::exception& e) {
            return std::string("error ") + e.what();
        }
    }
    std::string type_;
};

struct Participant {
    dds::DomainParticipant* participant = nullptr;
    dds::Topic* topic = nullptr;

    explicit Participant(const Options& options) {
        participant = dds::DomainParticipantFactory::get_instance()->create_participant(
            static_cast<std::uint32_t>(options.number("domain", 0)), options.participant());
        require(participant != nullptr, "a participant");
        const std::string type = options.text("type", "sensor_msgs::msg::dds_::PointCloud2_");
        dds::TypeSupport(new TypeOfBytes(type)).register_type(participant);
        topic = participant->create_topic(options.text("topic", "rt/points"), type,
                                          dds::TOPIC_QOS_DEFAULT);
        require(topic != nullptr, "a topic");
    }
    Participant(const Participant&) = delete;
    Participant& operator=(const Participant&) = delete;
    ~Participant() {
        if (participant == nullptr) return;
        participant->delete_contained_entities();
        dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
    }
};

void subscribe(const Options& options, bool decodes) {
    Participant p(options);
    Listener listener(decodes ? p.topic->get_type_name() : "");
    dds::Subscriber* const subscriber = p.participant->create_subscriber(options.subscriber());
    require(subscriber != nullptr, "a subscriber");
    require(subscriber->create_datareader(p.topic, options.reader(), &listener) != nullptr,
            "a reader");
    say("ready");
    while (!input_ended(-1)) continue;
    p.participant->delete_contained_entities();  // before the listener ends
}

/// False if standard input ended before there were so many subscribers.
bool wait_for_subscribers(dds::DataWriter& writer, int count) {
    dds::PublicationMatchedStatus status;
    while (writer.get_publication_matched_status(status) == ReturnCode_t::RETCODE_OK &&
           status.current_count < count) {
        if (input_ended(5)) return false;
    }
    return true;
}

void publish_random(const Options& options, dds::DataWriter& writer) {
    std::vector<std::size_t> sizes;
    std::istringstream list(options.text("sizes", "100"));
    for (std::string size; std::getline(list, size, ',');) sizes.push_back(std::stoul(size));
    const std::chrono::duration<double> pause(1.0 / options.number("rate", 1000));
    const auto count = static_cast<std::size_t>(options.number("count", 1));
    for (std::size_t i = 0; i < count; ++i) {
        Bytes message = random_message(sizes[i % sizes.size()], static_cast<unsigned>(i + 1));
        require(writer.write(&message), "room for a message");
        say("sent " + size_and_hash(message));
        std::this_thread::sleep_for(pause);
    }
}

void publish_input(dds::DataWriter& writer) {
    std::uint32_t size = 0;
    while (std::fread(&size, sizeof size, 1, stdin) == 1) {
        Bytes message(size);
        if (size > 0 && std::fread(message.data(), size, 1, stdin) != 1) return;
        require(writer.write(&message), "room for a message");
    }
}

void publish(const Options& options, bool relays) {
    Participant p(options);
    dds::Publisher* const publisher = p.participant->create_publisher(options.publisher());
    require(publisher != nullptr, "a publisher");
    dds::DataWriter* const writer = publisher->create_datawriter(p.topic, options.writer());
    require(writer != nullptr, "a writer");
    say("ready");
    if (!wait_for_subscribers(*writer, static_cast<int>(options.number("match", 1)))) return;
    if (relays) {
        publish_input(*writer);
    } else {
        publish_random(options, *writer);
    }
    constexpr int kPatience = 20;  // [s]
    writer->wait_for_acknowledgments({kPatience, 0});
    say("done");
    while (!relays && !input_ended(-1)) continue;
}

int run(int count, char** arguments) {
    const std::string mode = count > 1 ? arguments[1] : "";
    const Options options(count, arguments);
    if (mode == "publish" || mode == "relay") {
        publish(options, mode == "relay");
    } else if (mode == "subscribe" || mode == "decode") {
        subscribe(options, mode == "decode");
    } else {
        throw std::runtime_error("expected publish, relay, subscribe or decode");
    }
    return 0;
}

}  // namespace
}  // namespace dynamic_filter::peers

int main(int count, char** arguments) {
    try {
        return dynamic_filter::peers::run(count, arguments);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "fastdds_peer: %s\n", e.what());
        return 1;
    }
}
