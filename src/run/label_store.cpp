// SPDX-License-Identifier: MIT
#include "run/label_store.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "geometry/verdict_code.hpp"

namespace dynamic_filter::app {

namespace {

std::vector<std::uint8_t> packed(const Labels& labels) {
    std::vector<std::uint8_t> bytes((labels.size() + 3) / 4);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        bytes[i / 4] =
            static_cast<std::uint8_t>(bytes[i / 4] | verdict_code(labels[i]) << 2 * (i % 4));
    }
    return bytes;
}

[[noreturn]] void fail(const std::filesystem::path& folder, const char* what) {
    throw OutputError(folder, std::string(what) + ": " + std::generic_category().message(errno));
}

int open_without_name(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor >= 0) return descriptor;
#endif
    std::string name = (folder / ".labels-XXXXXX").string();  // file systems without it
    const int named = ::mkstemp(name.data());
    if (named < 0) fail(folder, "no file can be created in it");
    ::unlink(name.c_str());
    return named;
}

}  // namespace

LabelStore::~LabelStore() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void LabelStore::put(std::size_t scan, const Labels& labels) {
    const std::vector<std::uint8_t> bytes = packed(labels);
    const std::lock_guard hold(lock_);
    if (descriptor_ < 0) descriptor_ = open_without_name(folder_);
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t put = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done,
                                     static_cast<off_t>(end_ + done));
        if (put < 0 && errno != EINTR) fail(folder_, "cannot be written");
        if (put > 0) done += static_cast<std::size_t>(put);
    }
    places_[scan] = {end_, labels.size()};
    end_ += bytes.size();
}

/// The place of a scan's labels; empty if none were put.
LabelStore::Place LabelStore::place_of(std::size_t scan) const {
    const std::lock_guard hold(lock_);
    const auto place = places_.find(scan);
    return place == places_.end() ? Place{} : place->second;
}

Labels LabelStore::get(std::size_t scan) const {
    const auto [offset, count] = place_of(scan);
    std::vector<std::uint8_t> bytes((count + 3) / 4);
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done,
                                    static_cast<off_t>(offset + done));
        if (got == 0 || (got < 0 && errno != EINTR))
            fail(folder_, "what was written cannot be read back");
        if (got > 0) done += static_cast<std::size_t>(got);
    }
    Labels labels(count);
    for (std::size_t i = 0; i < count; ++i) labels[i] = label_of_code(bytes[i / 4] >> 2 * (i % 4));
    return labels;
}

}  // namespace dynamic_filter::app
