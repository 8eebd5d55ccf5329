// SPDX-License-Identifier: MIT
#include "recording/benchmark.hpp"

#include <algorithm>

#include "dynamic_filter/error.hpp"
#include "recording/viewpoints.hpp"

namespace dynamic_filter::io {
namespace {

enum class Verdict { truth, no_truth, undecided };

Verdict judge_intensity(const std::filesystem::path& scan) {
    try {
        const Cloud cloud = read_pcd(scan);
        const Field* intensity = cloud.find("intensity");
        if (intensity == nullptr) return Verdict::no_truth;
        Verdict verdict = Verdict::undecided;
        for (const double value : values(cloud, *intensity)) {
            if (value != 0.0 && value != 1.0) return Verdict::no_truth;
            if (value == 1.0) verdict = Verdict::truth;
        }
        return verdict;
    } catch (const InputError&) {
        return Verdict::undecided;
    }
}

bool all_intensities_are_flags(const Info& info) {
    bool any_dynamic = false;
    for (const auto& scan : info.scan_files) {
        const Verdict verdict = judge_intensity(scan);
        if (verdict == Verdict::no_truth) return false;
        any_dynamic = any_dynamic || verdict == Verdict::truth;
    }
    return any_dynamic;
}

/// Of the first, the middle and the last scan.
bool some_intensities_are_flags(const Info& info) {
    const std::size_t n = info.scan_files.size();
    for (const std::size_t i : {std::size_t{0}, n / 2, n - 1}) {
        if (judge_intensity(info.scan_files[i]) == Verdict::no_truth) return false;
    }
    return true;
}

}  // namespace

bool any_has_viewpoint(const Paths& scans) {
    return std::any_of(scans.begin(), scans.end(),
                       [](const auto& scan) { return viewpoint_of(scan).has_value(); });
}

void require_viewpoints(Info& info) {
    if (any_has_viewpoint(info.scan_files)) return;
    if (info.scan_files.size() > 1) {
        throw InputError(info.scan_files[0].parent_path(), "",
                         "no poses: VIEWPOINT of every scan is the identity; give poses with "
                         "--poses, and --format folder if the points are in the sensor's frame");
    }
    info.notes.emplace_back("VIEWPOINT is the identity; the sensor is taken to be there");
}

void find_intensity_truth(Info& info, const Layout& layout) {
    if (!info.label_files.empty()) return;  // label files are more precise
    // Beside a map of the truth, the intensities of some sets are the sensor's.
    info.intensity_is_truth =
        layout.truth_map ? some_intensities_are_flags(info) : all_intensities_are_flags(info);
    if (info.intensity_is_truth) {
        info.notes.emplace_back("intensity is taken as ground truth (1: dynamic)");
    }
}

}  // namespace dynamic_filter::io
