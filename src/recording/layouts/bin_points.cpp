// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/bin_layout.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/layouts.hpp"

namespace dynamic_filter::io {

namespace {

/// The names of the layouts that are tried, for messages.
std::string tried_layouts() {
    std::string tried;
    for (const BinLayout& layout : bin_layouts())
        tried += (tried.empty() ? "" : ", ") + to_string(layout);
    return tried;
}

/// True for .bin files, but not for .pcd.bin, whose layout is known.
bool are_plain_bins(const Paths& scans) {
    return std::all_of(scans.begin(), scans.end(), [](const auto& scan) {
        return extension_of(scan) == ".bin" && extension_of(scan.stem()) != ".pcd";
    });
}

/// Sizes of the files that are not empty, and the beginnings of three of them.
std::vector<BinSample> samples_of(const Paths& scans) {
    constexpr std::size_t most = 200, head = 1U << 18U;
    std::vector<BinSample> samples;
    std::vector<const std::filesystem::path*> files;
    for (const auto& scan : scans) {
        std::error_code error;
        const std::uintmax_t bytes = std::filesystem::file_size(scan, error);
        if (error || bytes == 0) continue;
        samples.push_back({.head = {}, .size = bytes});
        files.push_back(&scan);
        if (samples.size() == most) break;
    }
    for (const std::size_t part : {0U, 1U, 2U}) {
        if (samples.empty()) break;
        const std::size_t i = part * (samples.size() - 1) / 2;
        if (!samples[i].head.empty()) continue;
        try {
            const std::string text = read_head(*files[i], head);
            const auto bytes = std::as_bytes(std::span(text));
            samples[i].head.assign(bytes.begin(), bytes.end());
        } catch (const InputError&) {
            continue;  // it is rejected when it is read
        }
    }
    return samples;
}

/// Throws if the sizes of the files have a common divisor that is no multiple of KITTI's.
void refuse_other_sizes(const std::filesystem::path& folder,
                        const std::vector<BinSample>& samples) {
    constexpr std::size_t fewest = 4;  // sizes of fewer files may agree by chance
    std::uintmax_t common = 0;
    for (const BinSample& sample : samples) common = std::gcd(common, sample.size);
    // A truncated file among others leaves a much smaller common divisor.
    constexpr std::uintmax_t least = 12, own = 16;
    if (samples.size() < fewest || common < least || common % own == 0) return;
    throw InputError(
        folder, "",
        fmt::format(
            "its files seem to have {} bytes a point, because all their sizes are multiples "
            "of that, but their contents fit none of {}; {}",
            common, tried_layouts(),
            common == 20
                ? "if they are nuScenes's, name them *.pcd.bin"
                : "write float32 x y z intensity, or .npy arrays of N x 3 or more columns"));
}

}  // namespace

void choose_bin_points(Layout& layout) {
    if (!are_plain_bins(layout.scans)) return;
    const std::vector<BinSample> samples = samples_of(layout.scans);
    const BinChoice choice = choose_bin_layout(samples);
    const BinLayout& own = bin_layouts().front();
    if (!choice.layout) {
        refuse_other_sizes(layout.scan_folder, samples);
        throw InputError(
            layout.scans.front(), "",
            fmt::format("no layout of .bin files makes points of its contents; tried "
                        "{}; write float32 x y z intensity, or .npy arrays of N x 3 or "
                        "more columns",
                        tried_layouts()));
    }
    if (to_string(*choice.layout) == to_string(own))
        return refuse_other_sizes(layout.scan_folder, samples);
    const BinLayout chosen = *choice.layout;
    layout.read = [chosen](const std::filesystem::path& file) { return read_bin(file, chosen); };
    layout.refuse_bad_size = [chosen](const std::filesystem::path& file) {
        std::error_code unknown;  // the reader reports the error
        const auto bytes = std::filesystem::file_size(file, unknown);
        if (!unknown) refuse_bad_bin_size(file, static_cast<std::size_t>(bytes), chosen);
    };
    layout.notes.push_back(
        fmt::format("the .bin files are read as {}, because their contents fit "
                    "that best",
                    to_string(chosen)));
}

}  // namespace dynamic_filter::io
