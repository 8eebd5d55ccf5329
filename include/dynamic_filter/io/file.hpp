// SPDX-License-Identifier: MIT
/// @file
/// Files that appear whole or not at all.
///
/// - Units: [bytes].
/// - Shapes: bytes as they are.
/// - Ownership: an AtomicFile owns its descriptor; what it writes is borrowed for the call.
/// - Threads: single caller per file.
/// - Errors: InputError of a reader, OutputError of a writer, both with the system's reason.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace dynamic_filter::io {

/// Reads a whole regular file. Throws InputError (missing, a folder, a device, unreadable).
std::string read_file(const std::filesystem::path& file);

/// What outlasts a power cut once a file is committed.
enum class Durable {
    contents,  ///< what stands under its name is whole, but the name may be missing or lead to what
               ///< it led to before: until sync_folder()
    name       ///< the name, too
};

/// Makes the names of all files in a folder durable. Throws OutputError where the disk fails.
void sync_folder(const std::filesystem::path& folder);

/// A file that is written beside its final path and renamed into place by commit(); without
/// commit() (an exception, say) nothing is left. Throws OutputError with the system's reason.
/// Single caller; movable.
class AtomicFile {
public:
    /// Makes the temporary file, in the folder of `path`.
    explicit AtomicFile(std::filesystem::path path);
    AtomicFile(AtomicFile&& other) noexcept;  ///< the other one can only be destroyed
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile();

    void write(std::span<const std::byte> bytes);             ///< appends, buffered
    void write(std::string_view text);                        ///< as above
    void rewrite(std::size_t offset, std::string_view text);  ///< overwrites bytes already written
    /// Flushes, fsyncs, renames.
    void commit(Durable durable = Durable::name);
    /// What it is called until then, for libraries that write by name.
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

private:
    void flush();
    std::filesystem::path path_, temporary_;
    std::string buffer_;
    int descriptor_ = -1;
};

void write_file(const std::filesystem::path& path, std::string_view text);  ///< atomic

}  // namespace dynamic_filter::io
