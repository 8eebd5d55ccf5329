// SPDX-License-Identifier: MIT
#include "dynamic_filter/filter.hpp"

namespace dynamic_filter {

void MapContents::add(const MapContents& other) {
    observer = other.observer;
    observers += other.observers;
    voxels += other.voxels;
    if (other.beams) beams = other.beams;
    keyframes.insert(keyframes.end(), other.keyframes.begin(), other.keyframes.end());
    if (throughput.empty()) {
        throughput = other.throughput;
        return;
    }
    for (std::size_t i = 0; i < throughput.size(); ++i) {
        throughput[i].count += other.throughput[i].count;
    }
}

}  // namespace dynamic_filter
