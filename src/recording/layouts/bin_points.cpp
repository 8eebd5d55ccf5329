// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <numeric>

#include "dynamic_filter/error.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/layouts.hpp"

namespace dynamic_filter::io {

void refuse_other_floats(const std::filesystem::path& folder, const Paths& scans) {
    constexpr std::size_t fewest = 4, most = 200;  // sizes of fewer files may agree by chance
    std::uintmax_t common = 0;
    std::size_t files = 0;
    for (const auto& scan : scans) {
        if (extension_of(scan) != ".bin" || extension_of(scan.stem()) == ".pcd") return;
        std::error_code error;
        const std::uintmax_t bytes = std::filesystem::file_size(scan, error);
        if (error || bytes == 0) continue;
        common = std::gcd(common, bytes);
        if (++files == most) break;
    }
    // A truncated file among others leaves a much smaller common divisor.
    constexpr std::uintmax_t least = 12, own = 16;
    if (files < fewest || common < least || common % own == 0) return;
    throw InputError(
        folder, "",
        fmt::format(
            "its files seem to have {} bytes a point, because all their sizes are multiples "
            "of that; expected 16 (float32 x y z intensity); {}",
            common,
            common == 20 ? "if they are nuScenes's, name them *.pcd.bin"
                         : "write the points so, or as .npy arrays of N x 3 or more columns"));
}

}  // namespace dynamic_filter::io
