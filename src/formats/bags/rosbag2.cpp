// SPDX-License-Identifier: MIT
// Reads the SQLite file of a ROS 2 bag, with the tables `topics` and `messages`.
#include <fmt/format.h>
#include <sqlite3.h>
#include <zstd.h>

#include <map>

#include "dynamic_filter/error.hpp"
#include "formats/bags/bag_file.hpp"
#include "formats/bags/decompress.hpp"
#include "formats/byte_reader.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;

/// Percent-encodes the path, so that no character of it has a meaning in the URI.
std::string uri_of(const std::filesystem::path& path, const char* mode) {
    std::string uri = "file:";
    for (const char c : path.string()) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '_' || c == '-';
        uri += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return uri + "?" + mode;
}

Database open_database(const std::filesystem::path& path) {
    const auto open = [&](const char* mode) {
        sqlite3* raw = nullptr;
        const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_FULLMUTEX;
        sqlite3_open_v2(uri_of(path, mode).c_str(), &raw, flags, nullptr);
        return Database(raw, sqlite3_close);
    };
    const auto usable = [](const Database& database) {
        return sqlite3_exec(database.get(), "SELECT 1 FROM topics LIMIT 1", nullptr, nullptr,
                            nullptr) == SQLITE_OK;
    };
    Database database = open("mode=ro");
    // In a folder without write permission, SQLite cannot use a write-ahead log beside the file.
    if (!usable(database)) database = open("mode=ro&immutable=1");
    if (!usable(database)) {
        throw InputError(path, "",
                         fmt::format("is no ROS 2 bag: {}", sqlite3_errmsg(database.get())));
    }
    return database;
}

class Query {
public:
    Query(sqlite3* database, const char* sql) : statement_(nullptr, sqlite3_finalize) {
        sqlite3_stmt* raw = nullptr;
        sqlite3_prepare_v2(database, sql, -1, &raw, nullptr);
        statement_.reset(raw);
    }
    bool next() { return statement_ && (state_ = sqlite3_step(statement_.get())) == SQLITE_ROW; }
    /// Message of this statement; that of the database may belong to a statement of another thread.
    [[nodiscard]] const char* error() const { return sqlite3_errstr(state_); }
    [[nodiscard]] bool finished() const { return state_ == SQLITE_DONE; }
    void bind(std::int64_t value) { sqlite3_bind_int64(statement_.get(), 1, value); }
    [[nodiscard]] std::int64_t number(int column) const {
        return sqlite3_column_int64(statement_.get(), column);
    }
    [[nodiscard]] std::string text(int column) const { return std::string(as_text(bytes(column))); }
    [[nodiscard]] std::span<const std::byte> bytes(int column) const {
        const void* data = sqlite3_column_blob(statement_.get(), column);
        const int size = sqlite3_column_bytes(statement_.get(), column);
        return {static_cast<const std::byte*>(data),
                data == nullptr ? 0 : static_cast<std::size_t>(size)};
    }

private:
    std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement_;
    int state_ = SQLITE_ERROR;
};

/// Decompresses a message, because rosbag2 can compress messages one by one.
std::vector<std::byte> uncompressed(std::span<const std::byte> bytes) {
    constexpr std::uint32_t kZstd = 0xFD2FB528;
    if (bytes.size() < 4 || little_endian<std::uint32_t>(bytes.data()) != kZstd) {
        return {bytes.begin(), bytes.end()};
    }
    const auto size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) {
        throw Malformed("is compressed, but does not contain its uncompressed size");
    }
    Decompressed content = decompress("zstd", bytes, size);
    if (!content.complete) throw Malformed("is compressed, and damaged");
    return std::move(content.bytes);
}

/// Size from the header of the database. SQLite would read a truncated last page as if it ended in
/// zeros.
std::uint64_t declared_size(const std::filesystem::path& path) {
    constexpr std::size_t kHeader = 100, kPageSize = 16, kPages = 28;
    const std::string head = read_head(path, kHeader);
    if (head.size() < kHeader) return kHeader;
    const auto big_endian = [&](std::size_t at, std::size_t size) {
        std::uint64_t value = 0;
        for (std::size_t i = at; i < at + size; ++i) {
            value = value << 8U | static_cast<unsigned char>(head[i]);
        }
        return value;
    };
    const std::uint64_t page = big_endian(kPageSize, 2);
    return (page == 1 ? 65536 : page) * big_endian(kPages, 4);
}

class Rosbag2 final : public BagFile {
public:
    explicit Rosbag2(const std::filesystem::path& path)
        : path_(path), database_(open_database(path)) {}

    std::vector<Defect> for_each(const UseMessage& use) const override {
        std::vector<Defect> defects;
        std::error_code unknown;
        const std::uint64_t size = std::filesystem::file_size(path_, unknown);
        if (const auto declared = declared_size(path_); size < declared) {
            defects.push_back({fmt::format("is cut off: it has {} of {} bytes", size, declared)});
        }
        const auto topics = read_topics(defects);
        Query query(database_.get(),
                    "SELECT id, topic_id, timestamp, data FROM messages ORDER BY id");
        while (query.next()) {
            const auto topic = topics.find(query.number(1));
            if (topic == topics.end()) continue;
            const std::int64_t id = query.number(0);
            try {
                const auto data = uncompressed(query.bytes(3));
                use({topic->second, query.number(2), 0, static_cast<std::uint64_t>(id), data});
            } catch (const Malformed& error) {
                defects.push_back({fmt::format("message {} {}", id, error.what())});
            }
        }
        if (!query.finished()) {
            defects.push_back({fmt::format("its messages are damaged: {}", query.error())});
        }
        return defects;
    }

    std::vector<std::byte> read(std::uint64_t, std::uint64_t id) const override {
        Query query(database_.get(), "SELECT data FROM messages WHERE id = ?");
        query.bind(static_cast<std::int64_t>(id));
        const std::string where = fmt::format("message {}", id);
        if (!query.next()) throw InputError(path_, where, query.error());
        try {
            return uncompressed(query.bytes(0));
        } catch (const Malformed& error) {
            throw InputError(path_, where, error.what());
        }
    }

private:
    std::map<std::int64_t, Topic> read_topics(std::vector<Defect>& defects) const {
        std::map<std::int64_t, Topic> topics;
        Query query(database_.get(), "SELECT id, name, type, serialization_format FROM topics");
        while (query.next()) {
            if (query.text(3) != "cdr") continue;
            topics[query.number(0)] = {query.text(1), plain_type(query.text(2)),
                                       MessageEncoding::cdr};
        }
        if (!query.finished()) {
            defects.push_back({fmt::format("its list of topics is damaged: {}", query.error())});
        }
        return topics;
    }

    std::filesystem::path path_;
    Database database_;
};

}  // namespace

std::unique_ptr<BagFile> open_rosbag2(const std::filesystem::path& file) {
    // Checked here, because SQLite takes an empty file for a database.
    if (read_head(file, kSqliteMagic.size()) != kSqliteMagic) {
        throw InputError(file, "byte 0", "is no ROS 2 bag: it does not begin as SQLite files do");
    }
    return std::make_unique<Rosbag2>(file);
}

}  // namespace dynamic_filter::io
