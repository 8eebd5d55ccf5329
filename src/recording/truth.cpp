// SPDX-License-Identifier: MIT
#include "recording/truth.hpp"

namespace dynamic_filter::io {

std::vector<std::size_t> scans_with_truth(const Info& info) {
    std::vector<std::size_t> scans;
    for (std::size_t i = 0; i < info.scan_files.size(); ++i) {
        const bool has_file = !info.label_files.empty() && !info.label_files[i].empty();
        if (info.intensity_is_truth || has_file) scans.push_back(i);
    }
    return scans;
}

bool is_sparse_truth(std::size_t with_truth, std::size_t scans) {
    return with_truth < scans && 2 * with_truth <= scans;
}

}  // namespace dynamic_filter::io
