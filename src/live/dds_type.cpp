// SPDX-License-Identifier: MIT
#include "live/dds_type.hpp"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <cstring>

namespace dynamic_filter::live {

namespace {

constexpr std::size_t kHead = 4;  // [bytes] of the CDR header

struct Type : ddsi_sertype {};

/// A message inside of Cyclone DDS.
struct Sample : ddsi_serdata {
    Bytes message;
};

const Sample& sample_of(const ddsi_serdata* data) { return *static_cast<const Sample*>(data); }

Sample* new_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, Bytes message) {
    auto* sample = new Sample{};
    ddsi_serdata_init(sample, type, kind);
    sample->hash = type->serdata_basehash;
    sample->message = std::move(message);
    return sample;
}

std::size_t aligned(std::size_t size) { return (size + 3) / 4 * 4; }

/// The network sends multiples of four bytes.
Bytes padded(const Bytes& message) {
    if (message->size() % 4 == 0) return message;
    auto copy = std::make_shared<std::vector<std::byte>>();
    copy->reserve(aligned(message->size()));
    *copy = *message;
    copy->resize(aligned(message->size()));
    return copy;
}

// The functions below are called by Cyclone DDS; it knows no exceptions.

ddsi_serdata* from_network(const ddsi_sertype* type, ddsi_serdata_kind kind,
                           const nn_rdata* fragment, std::size_t size) noexcept try {
    if (size < kHead || size > kLargestMessage) return nullptr;
    auto bytes = std::make_shared<std::vector<std::byte>>(size);
    std::size_t done = 0;
    for (; fragment != nullptr; fragment = fragment->nextfrag) {
        const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
        if (end <= done) continue;  // fragments may overlap
        if (fragment->min > done) return nullptr;
        const unsigned char* payload =
            NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
        std::memcpy(bytes->data() + done, payload + (done - fragment->min), end - done);
        done = end;
    }
    return done == size ? new_sample(type, kind, std::move(bytes)) : nullptr;
} catch (const std::bad_alloc&) {
    return nullptr;
}

ddsi_serdata* from_parts(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                         const ddsrt_iovec_t* parts, std::size_t size) noexcept try {
    if (size < kHead || size > kLargestMessage) return nullptr;
    auto bytes = std::make_shared<std::vector<std::byte>>(size);
    std::size_t done = 0;
    for (ddsrt_msg_iovlen_t i = 0; i < count && done < size; ++i) {
        const std::size_t n = std::min<std::size_t>(parts[i].iov_len, size - done);
        std::memcpy(bytes->data() + done, parts[i].iov_base, n);
        done += n;
    }
    return new_sample(type, kind, std::move(bytes));
} catch (const std::bad_alloc&) {
    return nullptr;
}

ddsi_serdata* from_message(const ddsi_sertype* type, const Bytes& message) noexcept try {
    return message && message->size() >= kHead ? new_sample(type, SDK_DATA, padded(message))
                                               : nullptr;
} catch (const std::bad_alloc&) {
    return nullptr;
}

ddsi_serdata* without_data(const ddsi_sertype* type) {
    static const auto head = std::make_shared<const std::vector<std::byte>>(
        std::vector<std::byte>{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}});
    return new_sample(type, SDK_KEY, head);
}

constexpr ddsi_serdata_ops kSampleOps = {
    .eqkey = [](const ddsi_serdata*, const ddsi_serdata*) { return true; },
    .get_size =
        [](const ddsi_serdata* data) {
            return static_cast<std::uint32_t>(sample_of(data).message->size());
        },
    .from_ser = from_network,
    .from_ser_iov = from_parts,
    .from_keyhash = [](const ddsi_sertype* type,
                       const ddsi_keyhash*) { return without_data(type); },
    .from_sample = [](const ddsi_sertype* type, ddsi_serdata_kind kind,
                      const void* message) -> ddsi_serdata* {
        if (kind != SDK_DATA) return without_data(type);
        return from_message(type, *static_cast<const Bytes*>(message));
    },
    .to_ser =
        [](const ddsi_serdata* data, std::size_t offset, std::size_t size, void* to) {
            const auto& bytes = *sample_of(data).message;
            const std::size_t n = std::min(size, bytes.size() - std::min(offset, bytes.size()));
            std::memcpy(to, bytes.data() + offset, n);
            std::memset(static_cast<char*>(to) + n, 0, size - n);
        },
    .to_ser_ref = [](const ddsi_serdata* data, std::size_t offset, std::size_t size,
                     ddsrt_iovec_t* part) -> ddsi_serdata* {
        part->iov_base = const_cast<std::byte*>(sample_of(data).message->data() + offset);
        part->iov_len = size;
        return ddsi_serdata_ref(data);
    },
    .to_ser_unref = [](ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); },
    .to_sample = [](const ddsi_serdata* data, void* message, void**, void*) -> bool {
        *static_cast<Bytes*>(message) = sample_of(data).message;
        return true;
    },
    .to_untyped = [](const ddsi_serdata* data) -> ddsi_serdata* {
        ddsi_serdata* untyped = without_data(data->type);
        untyped->type = nullptr;
        return untyped;
    },
    .untyped_to_sample = [](const ddsi_sertype*, const ddsi_serdata*, void*, void**,
                            void*) -> bool { return true; },
    .free = [](ddsi_serdata* data) { delete static_cast<Sample*>(data); },
    .print = [](const ddsi_sertype*, const ddsi_serdata*, char* text, std::size_t size)
        -> std::size_t { return static_cast<std::size_t>(std::snprintf(text, size, "bytes")); },
    .get_keyhash = [](const ddsi_serdata*, ddsi_keyhash* hash,
                      bool) { std::memset(hash, 0, sizeof *hash); },
#ifdef DDS_HAS_SHM
    .get_sample_size = nullptr,  // only samples of fixed size go through shared memory
    .from_iox_buffer = nullptr,
#endif
};

constexpr ddsi_sertype_ops kTypeOps = {
    .version = ddsi_sertype_v0,
    .arg = nullptr,
    .free =
        [](ddsi_sertype* type) {
            ddsi_sertype_fini(type);
            delete static_cast<Type*>(type);
        },
    // Samples belong to the caller: they are shared pointers, which nobody else makes or clears.
    .zero_samples = [](const ddsi_sertype*, void*, std::size_t) {},
    .realloc_samples = [](void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {},
    .free_samples = [](const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {},
    .equal = [](const ddsi_sertype*, const ddsi_sertype*) { return true; },
    .hash = [](const ddsi_sertype*) -> std::uint32_t { return 0; },
    .type_id = nullptr,
    .type_map = nullptr,
    .type_info = nullptr,
    .derive_sertype = nullptr,
    .get_serialized_size = nullptr,
    .serialize_into = nullptr,
};

}  // namespace

dds_entity_t create_topic_of_bytes(dds_entity_t participant, const std::string& name,
                                   const std::string& type) {
    auto* sertype = new Type{};
    ddsi_sertype_init(sertype, type.c_str(), &kTypeOps, &kSampleOps, true);
    sertype->allowed_data_representation =
        DDS_DATA_REPRESENTATION_FLAG_XCDR1 | DDS_DATA_REPRESENTATION_FLAG_XCDR2;
    ddsi_sertype* given = sertype;
    const dds_entity_t topic =
        dds_create_topic_sertype(participant, name.c_str(), &given, nullptr, nullptr, nullptr);
    if (topic < 0) ddsi_sertype_unref(sertype);
    return topic;
}

std::optional<Bytes> pop_bytes(dds_entity_t reader) {
    while (true) {
        Bytes message;
        void* to = &message;
        dds_sample_info_t info{};
        if (dds_take(reader, &to, &info, 1, 1) <= 0) return std::nullopt;
        if (info.valid_data && message) return message;
    }
}

dds_return_t write_bytes(dds_entity_t writer, const Bytes& message) {
    return dds_write(writer, &message);
}

}  // namespace dynamic_filter::live
