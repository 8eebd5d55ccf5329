// SPDX-License-Identifier: MIT
/// A type of Fast DDS whose samples are the bytes of their CDR encoding, with its header.
#pragma once

#include <cstring>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <vector>

namespace dynamic_filter::peers {

using Bytes = std::vector<unsigned char>;

class TypeOfBytes final : public eprosima::fastdds::dds::TopicDataType {
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

public:
    explicit TypeOfBytes(const std::string& name) {
        setName(name.c_str());
        m_typeSize = 4;  // the smallest; payloads grow
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }
    bool serialize(void* data, Payload* payload) override {
        const Bytes& bytes = *static_cast<const Bytes*>(data);
        if (!bytes.empty()) std::memcpy(payload->data, bytes.data(), bytes.size());
        payload->length = static_cast<std::uint32_t>(bytes.size());
        return true;
    }
    bool deserialize(Payload* payload, void* data) override {
        static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
        return true;
    }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
    }
    void* createData() override { return new Bytes; }
    void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace dynamic_filter::peers
