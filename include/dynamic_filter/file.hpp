// SPDX-License-Identifier: MIT
/// @file
/// Reads whole files, and writes files that appear complete or not at all.
///
/// - Units: [bytes].
/// - Shapes: uninterpreted bytes.
/// - Ownership: an AtomicFile owns its file descriptor; the bytes to write are borrowed for the
///   call.
/// - Threads: single caller per file.
/// - Errors: InputError of readers, OutputError of writers; both contain the reason of the system.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace dynamic_filter::io {

/// Reads a whole regular file. Throws InputError if it is missing, a folder, a device, or
/// unreadable.
std::string read_file(const std::filesystem::path& file);

/// What survives a power failure after a file is committed.
enum class Durable {
    /// The contents are complete. Until sync_folder() is called, the name may be missing, or may
    /// still refer to an older file.
    contents,
    name  ///< the contents and the name
};

/// Makes the names of all files in a folder durable. Throws OutputError if the disk fails.
void sync_folder(const std::filesystem::path& folder);

/// Writes to a temporary file beside the final path; commit() renames it into place. Without
/// commit(), for example after an exception, no file is left. Throws OutputError with the reason of
/// the system. Single caller; movable.
class AtomicFile {
public:
    /// Creates the temporary file in the folder of `path`.
    explicit AtomicFile(std::filesystem::path path);
    AtomicFile(AtomicFile&& other) noexcept;  ///< the moved-from object can only be destroyed
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile();

    void write(std::span<const std::byte> bytes);  ///< appends bytes, buffered
    void write(std::string_view text);             ///< appends text, buffered
    /// Overwrites bytes that were already written.
    void rewrite(std::size_t offset, std::string_view text);
    /// Flushes the buffer, calls fsync, and renames the file.
    void commit(Durable durable = Durable::name);
    /// Path of the temporary file, for libraries that write to a named file.
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

private:
    void flush();
    std::filesystem::path path_, temporary_;
    std::string buffer_;
    int descriptor_ = -1;
};

/// Writes a whole file atomically.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace dynamic_filter::io
