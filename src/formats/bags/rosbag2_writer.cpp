// SPDX-License-Identifier: MIT
// Writes the SQLite file of a ROS 2 bag, with version 4 of its schema.
#include <fmt/format.h>
#include <sqlite3.h>

#include <limits>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/bags/bag_writers.hpp"
#include "formats/messages/definitions.hpp"

namespace dynamic_filter::io {
namespace {

// The file is visible to others only after it is renamed, so the journal of SQLite is not needed.
constexpr const char* kSchema = R"(
PRAGMA journal_mode = OFF;
PRAGMA synchronous = OFF;
PRAGMA locking_mode = EXCLUSIVE;
BEGIN;
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL,
    metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
    serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,
    type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL,
    encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL,
    type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,
    timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES (4, 'unknown');
)";

class Insert {
public:
    Insert(sqlite3* database, const char* sql) : statement_(nullptr, sqlite3_finalize) {
        sqlite3_stmt* raw = nullptr;
        sqlite3_prepare_v2(database, sql, -1, &raw, nullptr);
        statement_.reset(raw);
    }
    Insert& number(std::int64_t value) {
        sqlite3_bind_int64(statement_.get(), ++column_, value);
        return *this;
    }
    Insert& text(const std::string& value) {
        sqlite3_bind_text(statement_.get(), ++column_, value.data(), static_cast<int>(value.size()),
                          SQLITE_TRANSIENT);
        return *this;
    }
    Insert& bytes(std::span<const std::byte> value) {  // a null pointer would become NULL
        const void* data = value.empty() ? "" : static_cast<const void*>(value.data());
        sqlite3_bind_blob(statement_.get(), ++column_, data, static_cast<int>(value.size()),
                          SQLITE_STATIC);
        return *this;
    }
    bool run() {
        column_ = 0;
        const bool done = sqlite3_step(statement_.get()) == SQLITE_DONE;
        sqlite3_reset(statement_.get());
        return done;
    }

private:
    std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement_;
    int column_ = 0;
};

class Rosbag2Writer final : public BagWriter {
public:
    explicit Rosbag2Writer(const std::filesystem::path& path)
        : path_(path),
          file_(path),
          topics_(path, MessageEncoding::cdr),
          database_(open(file_.temporary()), sqlite3_close) {
        run(kSchema);
        insert_ = std::make_unique<Insert>(
            database_.get(), "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)");
    }

    [[nodiscard]] MessageEncoding encoding() const override { return MessageEncoding::cdr; }

    void write(const Topic& topic, std::int64_t time_ns, std::span<const std::byte> data) override {
        check_time(path_, time_ns);
        if (data.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
            throw OutputError(path_,
                              fmt::format("a message of {} bytes is too large", data.size()));
        }
        const auto [number, is_new] = topics_.number_of(topic);
        if (is_new) announce(topic);
        insert_->number(static_cast<std::int64_t>(number) + 1).number(time_ns).bytes(data);
        check(insert_->run());
    }

    void commit() override {
        run("COMMIT");
        insert_.reset();
        check(sqlite3_close(database_.release()) == SQLITE_OK);
        file_.commit();
    }

private:
    static sqlite3* open(const std::filesystem::path& file) {
        sqlite3* raw = nullptr;  // errors here show again at the first statement
        sqlite3_open_v2(file.c_str(), &raw, SQLITE_OPEN_READWRITE, nullptr);
        return raw;
    }
    void check(bool done) const {
        if (done) return;
        throw OutputError(path_,
                          fmt::format("cannot be written: {}", sqlite3_errmsg(database_.get())));
    }
    void run(const char* sql) const {
        check(sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK);
    }
    void announce(const Topic& topic) const {
        const std::string type = ros2_type(topic.type);
        check(Insert(database_.get(),
                     "INSERT INTO topics(name, type, serialization_format, offered_qos_profiles, "
                     "type_description_hash) VALUES (?, ?, 'cdr', ?, '')")
                  .text(topic.name)
                  .text(type)
                  .text(offered_qos(topic))
                  .run());
        check(Insert(database_.get(),
                     "INSERT INTO message_definitions(topic_type, encoding, "
                     "encoded_message_definition, type_description_hash) SELECT ?1, 'ros2msg', ?2, "
                     "'' WHERE NOT EXISTS (SELECT 1 FROM message_definitions WHERE topic_type = "
                     "?1)")
                  .text(type)
                  .text(full_definition(topic.type, MessageEncoding::cdr))
                  .run());
    }

    std::filesystem::path path_;
    AtomicFile file_;
    TopicTable topics_;
    std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database_;
    // Declared after the database, so that it is destroyed before it.
    std::unique_ptr<Insert> insert_;
};

}  // namespace

std::unique_ptr<BagWriter> create_rosbag2(const std::filesystem::path& file) {
    return std::make_unique<Rosbag2Writer>(file);
}

}  // namespace dynamic_filter::io
