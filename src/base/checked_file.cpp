// SPDX-License-Identifier: MIT
#include "base/checked_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <sstream>

#include "base/crc.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace dynamic_filter::app {

namespace {

const Bytef* raw(std::span<const std::byte> bytes) {
    return reinterpret_cast<const Bytef*>(bytes.data());
}

[[noreturn]] void refuse_damaged(const std::filesystem::path& file) {
    throw InputError(
        file, "",
        "is damaged; make it again: `dynamicfilter plan -o`, or remove it and give --resume");
}

}  // namespace

std::vector<std::byte> packed(std::span<const std::byte> bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::byte> result(size);
    compress2(reinterpret_cast<Bytef*>(result.data()), &size, raw(bytes), bytes.size(),
              Z_BEST_SPEED);
    result.resize(size);
    return result;
}

std::vector<std::byte> unpacked(std::span<const std::byte> bytes, std::size_t size,
                                const std::filesystem::path& file) {
    std::vector<std::byte> result(size);
    uLongf length = size;
    const int status =
        uncompress(reinterpret_cast<Bytef*>(result.data()), &length, raw(bytes), bytes.size());
    if (size > 0 && (status != Z_OK || length != size)) {
        refuse_damaged(file);
    }
    return result;
}

std::string fingerprint(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return fmt::format("{:016x}", hash);
}

void write_checked(const std::filesystem::path& file, std::string_view magic, std::string_view run,
                   std::span<const std::byte> bytes) {
    io::AtomicFile out(file);
    out.write(fmt::format("{} {} {:08x} {}\n", magic, run, crc_of(bytes), bytes.size()));
    out.write(bytes);
    out.commit();
}

std::vector<std::byte> read_checked(const std::filesystem::path& file, std::string_view magic,
                                    std::string_view run) {
    const std::string text = io::read_file(file);
    const std::size_t end = text.find('\n');
    if (!text.starts_with(std::string(magic) + " ") || end == std::string::npos) {
        throw InputError(file, "line 1",
                         fmt::format("expected \"{} ...\", which this version writes", magic));
    }
    std::istringstream words(text.substr(magic.size(), end - magic.size()));
    std::string of_run, crc;
    std::size_t size = 0;
    words >> of_run >> crc >> size;
    if (of_run != run) {
        throw ConfigError(file.string() +
                          ": belongs to a run of other recordings, settings or another version");
    }
    const auto bytes = std::as_bytes(std::span(text).subspan(end + 1));
    if (bytes.size() != size || crc != fmt::format("{:08x}", crc_of(bytes))) {
        refuse_damaged(file);
    }
    return {bytes.begin(), bytes.end()};
}

}  // namespace dynamic_filter::app
