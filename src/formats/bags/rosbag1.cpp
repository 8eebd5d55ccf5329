// SPDX-License-Identifier: MIT
// Format: ROS bag 2.0, a sequence of records. The index is not needed, so .bag.active and truncated
// files can be read.
#include <fmt/format.h>

#include <map>

#include "dynamic_filter/error.hpp"
#include "formats/bags/chunked_file.hpp"
#include "formats/bags/decompress.hpp"
#include "formats/bags/rosbag1_format.hpp"
#include "formats/byte_reader.hpp"
#include "formats/time_units.hpp"

namespace dynamic_filter::io {
namespace {

/// Header of a record: name=value fields, each with its length before it.
class Header {
public:
    explicit Header(std::span<const std::byte> bytes) {
        ByteReader in(bytes);
        while (in.left() > 0) {
            const std::string_view field = in.text();
            const std::size_t equals = field.find('=');
            if (equals == std::string_view::npos) throw Malformed("has a header without '='");
            fields_[field.substr(0, equals)] = field.substr(equals + 1);
        }
    }
    [[nodiscard]] std::string_view text(std::string_view name) const {
        const auto found = fields_.find(name);
        if (found == fields_.end()) throw Malformed("has no '" + std::string(name) + "'");
        return found->second;
    }
    template <class T>
    [[nodiscard]] T number(std::string_view name) const {
        const std::string_view value = text(name);
        if (value.size() != sizeof(T)) {
            throw Malformed("'" + std::string(name) + "' is " + std::to_string(value.size()) +
                            " bytes long");
        }
        return little_endian<T>(reinterpret_cast<const std::byte*>(value.data()));
    }

private:
    std::map<std::string_view, std::string_view> fields_;
};

struct Rosbag1Record {
    Header header;
    std::span<const std::byte> data;  // the bytes of the record that the file contains
    bool whole;
    [[nodiscard]] Rosbag1Opcode opcode() const {
        return static_cast<Rosbag1Opcode>(header.number<std::uint8_t>("op"));
    }
};
Rosbag1Record read_rosbag1_record(ByteReader& in) {
    const auto head = in.block();
    const auto length = in.number<std::uint32_t>();
    const bool whole = length <= in.left();
    return {Header(head), in.read(whole ? length : in.left()), whole};
}

class Rosbag1Reader {
public:
    explicit Rosbag1Reader(const UseMessage& use) : use_(use) {}

    void use(const Rosbag1Record& record, std::uint64_t chunk, std::uint64_t offset) {
        if (!record.whole) throw Malformed("is cut off");
        const Rosbag1Opcode opcode = record.opcode();
        if (opcode == Rosbag1Opcode::bag_header)
            index_at_ = record.header.number<std::uint64_t>("index_pos");
        if (opcode == Rosbag1Opcode::connection) add_connection(record);
        if (opcode == Rosbag1Opcode::message) use_message(record, chunk, offset);
    }

    /// Adds the defects that show only at the end of the file; `size` is its size.
    void finish(std::uint64_t size, std::vector<Defect>& defects) const {
        if (index_at_ == 0) {
            defects.push_back({"was never closed, so its end may be missing", false});
        }
        if (index_at_ > size) {
            defects.push_back(
                {fmt::format("ends at byte {}, before its index at byte {}", size, index_at_)});
        }
        if (unannounced_ > 0) {
            defects.push_back(
                {fmt::format("{} messages of connections without a connection record are left out",
                             unannounced_)});
        }
    }

private:
    void add_connection(const Rosbag1Record& record) {
        const Header connection(record.data);
        topics_.try_emplace(record.header.number<std::uint32_t>("conn"),
                            Topic{std::string(record.header.text("topic")),
                                  std::string(connection.text("type")), MessageEncoding::ros1});
    }
    void use_message(const Rosbag1Record& record, std::uint64_t chunk, std::uint64_t offset) {
        const auto topic = topics_.find(record.header.number<std::uint32_t>("conn"));
        if (topic == topics_.end()) {
            ++unannounced_;
            return;
        }
        const auto time = record.header.number<std::uint64_t>("time");
        const auto seconds = static_cast<std::int64_t>(time & 0xFFFFFFFFU);
        const auto nanoseconds = static_cast<std::int64_t>(time >> 32U);
        use_({topic->second, seconds * kSecond + nanoseconds, chunk, offset, record.data});
    }

    const UseMessage& use_;
    std::map<std::uint32_t, Topic> topics_;
    std::uint64_t index_at_ = 0;
    std::size_t unannounced_ = 0;
};

class Rosbag1 final : public ChunkedFile {
public:
    explicit Rosbag1(const std::filesystem::path& path) : ChunkedFile(path) {
        const auto head =
            file().read(0, std::min<std::uint64_t>(file().size(), kRosbag1Magic.size()));
        if (as_text(head) == kRosbag1Magic) return;
        const bool other = as_text(head).starts_with("#ROSBAG V1");
        throw InputError(path, "byte 0",
                         other ? "is a ROS bag of version 1; convert it with `rosbag fix`"
                               : "is no ROS bag: it does not begin with '#ROSBAG V2.0'");
    }

    std::vector<Defect> for_each(const UseMessage& use) const override {
        std::vector<Defect> defects;
        Rosbag1Reader reader(use);
        read_index(reader);
        for (std::uint64_t at = kRosbag1Magic.size(); at < file().size();) {
            try {
                const auto bytes = record_at(at);
                ByteReader in(bytes);
                const Rosbag1Record record = read_rosbag1_record(in);
                if (record.opcode() == Rosbag1Opcode::chunk) {
                    use_chunk(record, at, reader, defects);
                } else {
                    reader.use(record, kNoChunk, at);
                }
                at += bytes.size();
            } catch (const Malformed& error) {  // the start of the next record is then not known
                defects.push_back({fmt::format("the record at byte {} {}", at, error.what())});
                break;
            }
        }
        reader.finish(file().size(), defects);
        return defects;
    }

private:
    std::vector<std::byte> message_in(std::span<const std::byte> bytes,
                                      std::uint64_t offset) const override {
        ByteReader in(bytes, static_cast<std::size_t>(offset));
        const auto data = read_rosbag1_record(in).data;
        return {data.begin(), data.end()};
    }

    std::vector<std::byte> record_at(std::uint64_t at) const override {
        const std::uint64_t there = file().size() - at;
        const auto length_at = [&](std::uint64_t offset) -> std::uint64_t {
            if (offset + 4 > there) throw Malformed("is cut off");
            return little_endian<std::uint32_t>(file().read(at + offset, 4).data());
        };
        const std::uint64_t head = length_at(0);
        const std::uint64_t size = 4 + head + 4 + length_at(4 + head);
        return file().read(at, std::min(size, there));
    }

    /// Reads the connections from the index, which repeats them; so those of damaged chunks are
    /// known, too.
    void read_index(Rosbag1Reader& reader) const {
        try {
            const auto head = record_at(kRosbag1Magic.size());
            ByteReader first(head);
            const Rosbag1Record header = read_rosbag1_record(first);
            for (auto at = header.header.number<std::uint64_t>("index_pos");
                 at > 0 && at < file().size();) {
                const auto bytes = record_at(at);
                ByteReader in(bytes);
                const Rosbag1Record record = read_rosbag1_record(in);
                if (record.opcode() != Rosbag1Opcode::connection) return;
                reader.use(record, kNoChunk, at);
                at += bytes.size();
            }
        } catch (const Malformed&) {  // ignored, because the index is optional
        }
    }

    static Decompressed content_of(const Rosbag1Record& chunk) {
        return decompress(chunk.header.text("compression"), chunk.data,
                          chunk.header.number<std::uint32_t>("size"));
    }

    std::vector<std::byte> read_chunk(std::uint64_t at) const override {
        const auto bytes = record_at(at);
        ByteReader in(bytes);
        return content_of(read_rosbag1_record(in)).bytes;
    }

    static void use_chunk(const Rosbag1Record& chunk, std::uint64_t at, Rosbag1Reader& reader,
                          std::vector<Defect>& defects) {
        const auto note = [&](const std::string& what) {
            defects.push_back({fmt::format("the chunk at byte {} {}", at, what)});
        };
        try {
            const Decompressed content = content_of(chunk);
            if (!content.complete) note("is damaged or cut off; only its readable part was read");
            ByteReader in(content.bytes);
            while (in.left() > 0) {
                const std::size_t offset = in.at();
                reader.use(read_rosbag1_record(in), at, offset);
            }
        } catch (const Malformed& error) {
            note(error.what());
        }
    }
};

}  // namespace

std::unique_ptr<BagFile> open_rosbag1(const std::filesystem::path& file) {
    return std::make_unique<Rosbag1>(file);
}

}  // namespace dynamic_filter::io
