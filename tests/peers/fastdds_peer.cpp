// SPDX-License-Identifier: MIT
// Another implementation of DDS, eProsima's Fast DDS, at the other end of the wire:
//   fastdds_peer publish|relay|subscribe|decode OPTION=VALUE...
// publish reads lines "COUNT RATE SIZE..." from standard input, sends so many messages of these
// sizes in turn, at so many per second, and prints the size and the FNV-1a hash of each, and
// "done". relay sends the messages of standard input, each behind its size in four bytes. subscribe
// prints the size and the hash of what it gets, decode the fields. All end with their standard
// input. See Options for the rest.

#include <algorithm>
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
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "peers/cdr_text.hpp"
#include "peers/fastdds_options.hpp"

namespace dynamic_filter::peers {
namespace {

namespace dds = eprosima::fastdds::dds;

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

/// Random bytes behind a CDR header in little endian, which has four bytes.
Bytes random_message(std::size_t size, unsigned seed) {
    constexpr std::size_t kHead = 4;
    std::minstd_rand random(seed);
    Bytes message(std::max(size, kHead));
    for (unsigned char& byte : message) byte = static_cast<unsigned char>(random() >> 8);
    for (std::size_t i = 0; i < kHead; ++i) message[i] = i == 1 ? 1 : 0;
    return message;
}

void wait_for_end_of_input() {
    while (std::getc(stdin) != EOF) continue;
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
        while (reader->take_next_sample(&message, &info) == kTaken) {
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
    wait_for_end_of_input();
    p.participant->delete_contained_entities();  // before the listener ends
}

void publish_random(dds::DataWriter& writer) {
    unsigned seed = 0;
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream words(line);
        std::size_t count = 0;
        double rate = 0;
        words >> count >> rate;
        const std::vector<std::size_t> sizes{std::istream_iterator<std::size_t>(words), {}};
        require(rate > 0 && !sizes.empty(), "sense of a line");
        for (std::size_t i = 0; i < count; ++i) {
            Bytes message = random_message(sizes[i % sizes.size()], ++seed);
            require(is_sent(writer.write(&message)), "room for a message");
            say("sent " + size_and_hash(message));
            std::this_thread::sleep_for(std::chrono::duration<double>(1 / rate));
        }
        say("done");
    }
}

void publish_input(dds::DataWriter& writer) {
    std::uint32_t size = 0;
    while (std::fread(&size, sizeof size, 1, stdin) == 1) {
        Bytes message(size);
        if (size > 0 && std::fread(message.data(), size, 1, stdin) != 1) return;
        require(is_sent(writer.write(&message)), "room for a message");
    }
}

void publish(const Options& options, bool relays) {
    Participant p(options);
    dds::Publisher* const publisher = p.participant->create_publisher(options.publisher());
    require(publisher != nullptr, "a publisher");
    dds::DataWriter* const writer = publisher->create_datawriter(p.topic, options.writer());
    require(writer != nullptr, "a writer");
    say("ready");
    if (relays) {
        publish_input(*writer);
    } else {
        publish_random(*writer);
    }
    constexpr int kPatience = 20;  // [s]
    writer->wait_for_acknowledgments({kPatience, 0});
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
