// SPDX-License-Identifier: MIT
#include "recording/repeats.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <system_error>

namespace dynamic_filter::io {
namespace {

constexpr std::uintmax_t kNoSize = static_cast<std::uintmax_t>(-1);
constexpr std::uintmax_t kFewBytes = 4096;  // too few for a scan that cannot be like another one

std::uintmax_t size_of_file(const std::filesystem::path& file) {
    std::error_code error;
    const bool regular = std::filesystem::is_regular_file(file, error);
    const auto size = regular ? std::filesystem::file_size(file, error) : kNoSize;
    return error ? kNoSize : size;
}

/// Of files of the same size. Those that differ do so early.
bool have_same_bytes(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::ifstream file_a(a, std::ios::binary), file_b(b, std::ios::binary);
    std::array<char, 16384> part_a{}, part_b{};
    while (file_a && file_b) {
        file_a.read(part_a.data(), part_a.size());
        file_b.read(part_b.data(), part_b.size());
        const auto count = file_a.gcount();
        if (count != file_b.gcount()) return false;
        if (!std::equal(part_a.begin(), part_a.begin() + count, part_b.begin())) return false;
    }
    return file_a.eof() && file_b.eof();
}

}  // namespace

std::vector<std::uint8_t> repeats_among(const Paths& files) {
    std::vector<std::uint8_t> repeats(files.size(), 0);
    std::uintmax_t before = kNoSize;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::uintmax_t size = size_of_file(files[i]);
        const bool is_alike = size == before && size != kNoSize && size > kFewBytes;
        repeats[i] = is_alike && have_same_bytes(files[i - 1], files[i]) ? 1 : 0;
        before = size;
    }
    const auto count = std::accumulate(repeats.begin(), repeats.end(), std::size_t{0});
    if (count == 0 || 2 * count > files.size()) return {};
    return repeats;
}

}  // namespace dynamic_filter::io
