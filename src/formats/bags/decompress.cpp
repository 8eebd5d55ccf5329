// SPDX-License-Identifier: MIT
#include "formats/bags/decompress.hpp"

#include <bzlib.h>
#include <lz4.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <new>

#include "formats/byte_reader.hpp"

namespace dynamic_filter::io {
namespace {

/// Numbers of bytes that one step read and wrote; `end`: the stream is complete.
struct Step {
    std::size_t taken = 0, given = 0;
    bool end = false, damaged = false;
};
using Decoder = std::function<Step(std::span<const std::byte> in, std::span<std::byte> out)>;

std::uint64_t most_output(std::size_t input, std::uint64_t declared) {
    constexpr std::uint64_t kFree = std::uint64_t{64} << 20U, kRatio = 1000;
    return std::min(declared, kFree + kRatio * input);
}

/// Whether what follows the whole content, such as its checksum, agrees with it. Nothing may follow
/// if the file was cut off there.
bool ends_well(const Decoder& decode, std::span<const std::byte> in) {
    std::byte beyond[1];
    while (!in.empty()) {
        const Step step = decode(in, beyond);
        if (step.damaged || step.given > 0) return false;
        if (step.end || step.taken == 0) break;
        in = in.subspan(step.taken);
    }
    return true;
}

/// Runs the decoder until it ends, makes no progress, or has written `most` bytes.
Decompressed run(const Decoder& decode, std::span<const std::byte> in, std::uint64_t declared) {
    constexpr std::size_t kStep = std::size_t{1} << 20U;
    const std::uint64_t most = most_output(in.size(), declared);
    Decompressed out;
    std::size_t done = 0;
    while (true) {
        const std::size_t room = std::min<std::uint64_t>(most - done, std::max(kStep, done));
        out.bytes.resize(done + room);
        const Step step = decode(in, std::span(out.bytes).subspan(done));
        done += step.given;
        if (step.damaged) break;
        in = in.subspan(step.taken);
        if (step.end || done == declared) {
            out.complete = done == declared && (step.end || ends_well(decode, in));
            break;
        }
        if (done == most || (step.taken == 0 && step.given == 0)) break;
    }
    out.bytes.resize(done);
    return out;
}

Decompressed unzstd(std::span<const std::byte> bytes, std::uint64_t size) {
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                            ZSTD_freeDStream);
    if (!stream) throw std::bad_alloc();
    // Limits the memory of the window before any content is read.
    ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, 27);
    return run(
        [&](std::span<const std::byte> in, std::span<std::byte> out) -> Step {
            ZSTD_inBuffer from{in.data(), in.size(), 0};
            ZSTD_outBuffer to{out.data(), out.size(), 0};
            const std::size_t left = ZSTD_decompressStream(stream.get(), &to, &from);
            const bool damaged = ZSTD_isError(left) != 0;
            return {from.pos, to.pos, left == 0 && from.pos == in.size(), damaged};
        },
        bytes, size);
}

Decompressed unlz4_block(std::span<const std::byte> bytes, std::uint64_t size) {
    constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    constexpr std::uint64_t kRatio = 255;  // largest ratio of the format
    const std::uint64_t most = std::min<std::uint64_t>(size, kRatio * bytes.size());
    if (most > kMost || bytes.size() > kMost) return {};
    Decompressed out{std::vector<std::byte>(static_cast<std::size_t>(most)), false};
    const int got = LZ4_decompress_safe_partial(
        reinterpret_cast<const char*>(bytes.data()), reinterpret_cast<char*>(out.bytes.data()),
        static_cast<int>(bytes.size()), static_cast<int>(most), static_cast<int>(most));
    out.bytes.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    out.complete = out.bytes.size() == size;
    return out;
}

Decompressed unlz4(std::span<const std::byte> bytes, std::uint64_t size) {
    constexpr std::uint32_t kFrame = 0x184D2204;
    if (bytes.size() < 4 || little_endian<std::uint32_t>(bytes.data()) != kFrame) {
        return unlz4_block(bytes, size);
    }
    LZ4F_dctx* raw = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0)
        throw std::bad_alloc();
    const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
        raw, LZ4F_freeDecompressionContext);
    return run(
        [&](std::span<const std::byte> in, std::span<std::byte> out) -> Step {
            std::size_t taken = in.size(), given = out.size();
            const std::size_t left =
                LZ4F_decompress(context.get(), out.data(), &given, in.data(), &taken, nullptr);
            return {taken, given, left == 0, LZ4F_isError(left) != 0};
        },
        bytes, size);
}

Decompressed unbz2(std::span<const std::byte> bytes, std::uint64_t size) {
    bz_stream stream{};
    if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
    const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream,
                                                                         BZ2_bzDecompressEnd);
    return run(
        [&](std::span<const std::byte> in, std::span<std::byte> out) -> Step {
            constexpr std::size_t kMost = std::size_t{1} << 30U;
            // bzip2 promises not to change its input.
            stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(in.data()));
            stream.avail_in = static_cast<unsigned>(std::min(in.size(), kMost));
            stream.next_out = reinterpret_cast<char*>(out.data());
            stream.avail_out = static_cast<unsigned>(std::min(out.size(), kMost));
            const unsigned in_before = stream.avail_in, out_before = stream.avail_out;
            const int state = BZ2_bzDecompress(&stream);
            return {in_before - stream.avail_in, out_before - stream.avail_out,
                    state == BZ_STREAM_END, state != BZ_OK && state != BZ_STREAM_END};
        },
        bytes, size);
}

}  // namespace

Decompressed decompress(std::string_view name, std::span<const std::byte> bytes,
                        std::uint64_t size) {
    if (name.empty() || name == "none") {
        return {{bytes.begin(), bytes.end()}, bytes.size() == size};
    }
    if (name == "zstd") return unzstd(bytes, size);
    if (name == "lz4") return unlz4(bytes, size);
    if (name == "bz2") return unbz2(bytes, size);
    throw Malformed("is compressed with '" + std::string(name.substr(0, 20)) +
                    "'; expected zstd, lz4, bz2 or none");
}

}  // namespace dynamic_filter::io
