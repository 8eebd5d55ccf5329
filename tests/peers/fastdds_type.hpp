// SPDX-License-Identifier: MIT
/// A type of Fast DDS whose samples are the bytes of their CDR encoding, with its header.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "peers/fastdds_version.hpp"

namespace dynamic_filter::peers {

using Bytes = std::vector<unsigned char>;

class TypeOfBytes final : public eprosima::fastdds::dds::TopicDataType {
public:
    explicit TypeOfBytes(const std::string& name) {
        constexpr std::uint32_t kSmallest = 4;  // payloads grow
#ifdef DYNAMIC_FILTER_FASTDDS_3
        set_name(name);
        max_serialized_type_size = kSmallest;
    }
    using Representation = eprosima::fastdds::dds::DataRepresentationId_t;
    bool serialize(const void* data, Payload& payload, Representation) override {
        return write(data, payload);
    }
    bool deserialize(Payload& payload, void* data) override { return read(payload, data); }
    std::uint32_t calculate_serialized_size(const void* data, Representation) override {
        return size_of(data);
    }
    void* create_data() override { return new Bytes; }
    void delete_data(void* data) override { delete static_cast<Bytes*>(data); }
    bool compute_key(Payload&, InstanceHandle&, bool) override { return false; }
    bool compute_key(const void*, InstanceHandle&, bool) override { return false; }
#else
        setName(name.c_str());
        m_typeSize = kSmallest;
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }
    bool serialize(void* data, Payload* payload) override { return write(data, *payload); }
    bool deserialize(Payload* payload, void* data) override { return read(*payload, data); }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] { return size_of(data); };
    }
    void* createData() override { return new Bytes; }
    void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
    bool getKey(void*, InstanceHandle*, bool) override { return false; }
#endif

private:
    static std::uint32_t size_of(const void* data) {
        return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
    }
    static bool write(const void* data, Payload& payload) {
        const Bytes& bytes = *static_cast<const Bytes*>(data);
        if (!bytes.empty()) std::memcpy(payload.data, bytes.data(), bytes.size());
        payload.length = size_of(data);
        return true;
    }
    static bool read(const Payload& payload, void* data) {
        static_cast<Bytes*>(data)->assign(payload.data, payload.data + payload.length);
        return true;
    }
};

}  // namespace dynamic_filter::peers
