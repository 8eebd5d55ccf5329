// SPDX-License-Identifier: MIT
#include "dynamic_filter/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20U;

std::string reason() { return std::strerror(errno); }

/// A file descriptor for reading, closed by the destructor.
struct Descriptor {
    explicit Descriptor(int opened) : number(opened) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
    int number;
};

const char* special_kind(mode_t mode) {
    if (S_ISDIR(mode)) return "is a folder; expected a file";
    if (S_ISFIFO(mode)) return "is a pipe; expected a regular file, save the stream to one first";
    if (S_ISSOCK(mode)) return "is a socket; expected a regular file";
    return "is a device; expected a regular file";
}

/// Size of an open regular file; throws for everything else.
std::size_t regular_size(int descriptor, const std::filesystem::path& file) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0)
        throw InputError(file, "", "cannot be read: " + reason());
    if (!S_ISREG(status.st_mode)) throw InputError(file, "", special_kind(status.st_mode));
    return static_cast<std::size_t>(status.st_size);
}

template <typename Buffer>
void allocate(Buffer& buffer, std::size_t size, const std::filesystem::path& file) {
    try {
        buffer.resize(size);
    } catch (const std::exception&) {  // bad_alloc, or length_error for a huge sparse file
        throw InputError(file, "", "its " + std::to_string(size) + " bytes do not fit in memory");
    }
}

int open_for_reading(const std::filesystem::path& file) {
    // With O_NONBLOCK, opening a pipe does not wait for a writer.
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) throw InputError(file, "", "cannot be opened: " + reason());
    return descriptor;
}

template <typename Buffer>
void fill(Buffer& buffer, int descriptor, std::uint64_t offset, const std::filesystem::path& file) {
    for (std::size_t done = 0; done < buffer.size();) {
        const ssize_t got = ::pread(descriptor, buffer.data() + done, buffer.size() - done,
                                    static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        const std::string where = "byte " + std::to_string(offset + done);
        if (got < 0) throw InputError(file, where, "cannot be read: " + reason());
        if (got == 0) throw InputError(file, where, "became shorter while it was read; try again");
        done += static_cast<std::size_t>(got);
    }
}

template <typename Buffer>
Buffer read_up_to(const std::filesystem::path& file, std::size_t most) {
    const Descriptor input(open_for_reading(file));
    Buffer buffer;
    allocate(buffer, std::min(regular_size(input.number, file), most), file);
    fill(buffer, input.number, 0, file);
    return buffer;
}

void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& path) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) throw OutputError(path, "cannot be written: " + reason());
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
    static std::atomic<unsigned> counter{0};
    return folder_of(path) / ("." + path.filename().string() + ".tmp." +
                              std::to_string(::getpid()) + "." + std::to_string(counter++));
}

/// Throws if the target is a device or a folder: renaming onto it would replace it or fail, so this
/// is checked before any work is done.
void refuse_special(const std::filesystem::path& path) {
    if (!path.has_filename()) throw OutputError(path, "names a folder; expected a file name");
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
        throw OutputError(path, special_kind(status.st_mode));
    }
}

}  // namespace

std::vector<std::byte> read_bytes(const std::filesystem::path& file) {
    return read_up_to<std::vector<std::byte>>(file, std::numeric_limits<std::size_t>::max());
}

std::string read_head(const std::filesystem::path& file, std::size_t most) {
    return read_up_to<std::string>(file, most);
}

std::string read_file(const std::filesystem::path& file) {
    return read_up_to<std::string>(file, std::numeric_limits<std::size_t>::max());
}

std::string kind_by_content(std::string_view head) {
    if (head.starts_with("\x89MCAP")) return "an MCAP bag";
    if (head.starts_with("#ROSBAG V")) return "a ROS 1 bag";
    if (head.starts_with("SQLite format 3")) return "a ROS 2 bag";
    if (head.starts_with("LASF")) return "a LAS cloud";
    if (head.starts_with("\x93NUMPY")) return "a NumPy array";
    if (head.starts_with("ply\n") || head.starts_with("ply\r")) return "a PLY cloud";
    if (head.starts_with("# .PCD")) return "a PCD cloud";
    if (head.starts_with("PK\x03\x04")) return "a zip archive";
    if (head.starts_with("\x1F\x8B")) return "a gzip archive";
    return head.find('\0') == std::string_view::npos ? "" : "a binary file";
}

InputFile::InputFile(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(open_for_reading(path_)) {
    try {
        size_ = regular_size(descriptor_, path_);
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

InputFile::~InputFile() { ::close(descriptor_); }

std::vector<std::byte> InputFile::read(std::uint64_t offset, std::uint64_t count) const {
    if (offset > size_ || count > size_ - offset) {
        throw InputError(path_, "byte " + std::to_string(offset),
                         std::to_string(count) + " bytes should follow, but the file ends at " +
                             std::to_string(size_));
    }
    std::vector<std::byte> bytes;
    allocate(bytes, static_cast<std::size_t>(count), path_);
    fill(bytes, descriptor_, offset, path_);
    return bytes;
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
    // A symbolic link is kept; the file to which it points is replaced.
    std::error_code unresolved;
    if (std::filesystem::is_symlink(path_, unresolved)) {
        const auto target = std::filesystem::canonical(path_, unresolved);
        if (unresolved)
            throw OutputError(path_, "is a link to a missing file; remove the link first");
        path_ = target;
    }
    refuse_special(path_);
    do {  // skips names left by a crashed process with the same id
        temporary_ = temporary_name(path_);
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) throw OutputError(path_, "cannot be created: " + reason());
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {
    other.temporary_.clear();
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) { write(as_text(bytes)); }

void AtomicFile::write(std::string_view text) {
    if (buffer_.size() + text.size() > buffer_bytes) flush();
    if (text.size() > buffer_bytes) {
        write_all(descriptor_, text, path_);
    } else {
        buffer_.append(text);
    }
}

void AtomicFile::flush() {
    write_all(descriptor_, buffer_, path_);
    buffer_.clear();
}

void AtomicFile::rewrite(std::size_t offset, std::string_view text) {
    flush();
    const off_t end = ::lseek(descriptor_, 0, SEEK_CUR);
    if (end < 0 || offset + text.size() > static_cast<std::size_t>(end)) {
        throw OutputError(path_, "rewrite beyond its end");
    }
    while (!text.empty()) {
        const ssize_t put =
            ::pwrite(descriptor_, text.data(), text.size(), static_cast<off_t>(offset));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) throw OutputError(path_, "cannot be written: " + reason());
        text.remove_prefix(static_cast<std::size_t>(put));
        offset += static_cast<std::size_t>(put);
    }
}

void AtomicFile::commit(Durable durable) {
    flush();
    if (::fsync(descriptor_) != 0 && errno != EINVAL) {
        throw OutputError(path_, "cannot be synced: " + reason());
    }
    if (::close(std::exchange(descriptor_, -1)) != 0) {
        throw OutputError(path_, "cannot be closed: " + reason());
    }
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
        throw OutputError(path_, "cannot be renamed into place: " + reason());
    }
    temporary_.clear();
    if (durable == Durable::name) sync_folder(folder_of(path_));
}

/// Some file systems cannot sync folders, which is no error.
void sync_folder(const std::filesystem::path& folder) {
    const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.number < 0 || ::fsync(opened.number) == 0) return;
    if (errno == EIO || errno == ENOSPC || errno == EDQUOT) {
        throw OutputError(folder, "the folder cannot be synced: " + reason());
    }
}

void write_file(const std::filesystem::path& path, std::string_view text) {
    AtomicFile file(path);
    file.write(text);
    file.commit();
}

}  // namespace dynamic_filter::io
