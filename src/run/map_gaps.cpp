// SPDX-License-Identifier: MIT
#include "run/map_gaps.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include "base/little_endian.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace dynamic_filter::app {

Gaps gaps_of(const Points& points) {
    Gaps gaps;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (is_measured(points[i])) continue;
        if (!gaps.empty() && gaps.back().first + gaps.back().second == i) {
            ++gaps.back().second;
        } else {
            gaps.emplace_back(i, 1U);
        }
    }
    return gaps;
}

void write_gaps(const std::filesystem::path& folder, const std::vector<Gaps>& scans) {
    if (std::all_of(scans.begin(), scans.end(), [](const Gaps& g) { return g.empty(); })) return;
    std::string bytes;
    for (const Gaps& gaps : scans) {
        put(bytes, static_cast<std::uint32_t>(gaps.size()));
        for (const auto& [first, count] : gaps) {
            put(bytes, first);
            put(bytes, count);
        }
    }
    io::write_file(folder / kGapsFile, bytes);
}

std::vector<Gaps> read_gaps(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / kGapsFile;
    std::vector<Gaps> scans;
    if (!std::filesystem::exists(file)) return scans;
    const std::string bytes = io::read_file(file);
    std::size_t at = 0;
    const auto next_number = [&] {
        std::uint32_t value = 0;
        if (bytes.size() - at < sizeof value) {
            throw InputError(file, "", "ends too early; run again with --overwrite");
        }
        std::memcpy(&value, bytes.data() + at, sizeof value);
        at += sizeof value;
        return value;
    };
    while (at < bytes.size()) {
        Gaps& gaps = scans.emplace_back();
        for (std::uint32_t n = next_number(); n > 0; --n) {
            const std::uint32_t first = next_number();
            gaps.emplace_back(first, next_number());
        }
    }
    return scans;
}

}  // namespace dynamic_filter::app
