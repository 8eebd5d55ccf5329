// SPDX-License-Identifier: MIT
#include "formats/knowable_file.hpp"

#include <fmt/format.h>

#include <cstring>

#include "base/little_endian.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {

namespace {

constexpr std::size_t kRecord = 4;  // bytes

/// `bytes` are those of one record; `at` is where it begins in the file.
KnowablePoint point_of(const char* bytes, const std::filesystem::path& file, std::size_t at) {
    KnowablePoint point;
    std::memcpy(&point.beams, bytes, sizeof point.beams);
    const auto state = static_cast<unsigned char>(bytes[2]);
    const auto is_seen = static_cast<unsigned char>(bytes[3]);
    if (state > static_cast<unsigned char>(ThingState::never) || is_seen > 1) {
        throw InputError(
            file, fmt::format("byte {}", at + 2),
            fmt::format("state {} and mark {}; expected 0 to 4, and 0 or 1", state, is_seen));
    }
    point.state = static_cast<ThingState>(state);
    point.is_seen_moving = is_seen == 1;
    return point;
}

}  // namespace

void write_knowable(const std::filesystem::path& file, std::span<const KnowablePoint> points,
                    Durable durable) {
    std::string bytes;
    bytes.reserve(kRecord * points.size());
    for (const KnowablePoint& point : points) {
        app::put(bytes, point.beams);
        app::put(bytes, static_cast<std::uint8_t>(point.state));
        app::put(bytes, static_cast<std::uint8_t>(point.is_seen_moving));
    }
    AtomicFile out(file);
    out.write(bytes);
    out.commit(durable);
}

std::vector<KnowablePoint> read_knowable(const std::filesystem::path& file, std::size_t points) {
    const std::string bytes = read_file(file);
    if (bytes.size() != kRecord * points) {
        throw InputError(file, "",
                         fmt::format("has {} bytes; expected {}, which are {} for each of the {} "
                                     "points of the scan",
                                     bytes.size(), kRecord * points, kRecord, points));
    }
    std::vector<KnowablePoint> out(points);
    for (std::size_t i = 0; i < points; ++i) {
        out[i] = point_of(bytes.data() + kRecord * i, file, kRecord * i);
    }
    return out;
}

}  // namespace dynamic_filter::io
