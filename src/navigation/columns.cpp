// SPDX-License-Identifier: MIT
#include "navigation/columns.hpp"

#include <algorithm>
#include <cmath>

namespace dynamic_filter::app {

namespace {

constexpr float kBin = 0.05F;         // [m] of height
constexpr int kGap = 2;               // bins: a column that is empty for longer has two surfaces
constexpr std::uint32_t kStray = 32;  // of the most points in a bin, one in so many is noise

struct FilledBin {
    Cell cell;
    std::uint32_t points;
    float height;
};

/// Without the noise at both ends.
Surface surface_of(const FilledBin* begin, const FilledBin* end) {
    Surface surface{begin->cell.x(), begin->cell.y()};
    std::uint32_t most = 0;
    for (const FilledBin* bin = begin; bin != end; ++bin) {
        surface.points += bin->points;
        most = std::max(most, bin->points);
    }
    const auto counts = [&](const FilledBin& bin) { return bin.points * kStray >= most; };
    const FilledBin* const first = std::find_if(begin, end, counts);
    const FilledBin* last = end - 1;
    while (!counts(*last)) --last;
    if (first->cell.z() - begin->cell.z() <= kGap) begin = first;
    if ((end - 1)->cell.z() - last->cell.z() <= kGap) end = last + 1;
    surface.bottom = begin->height;
    surface.top = (end - 1)->height;
    // Points of flat ground lie in two bins if it lies at their border.
    if (end - begin == 2 && last->cell.z() - begin->cell.z() == 1) {
        const auto n = [](const FilledBin& bin) { return static_cast<float>(bin.points); };
        surface.bottom = surface.top =
            (n(*begin) * begin->height + n(*last) * last->height) / (n(*begin) + n(*last));
    }
    return surface;
}

}  // namespace

void Columns::add(const Point& point, std::uint32_t count) {
    const Eigen::Array3f scaled = point.array() / Eigen::Array3f(cell_, cell_, kBin);
    if (!(scaled.abs() < static_cast<float>(kCellLimit)).all()) return;
    const Cell cell = scaled.floor().cast<int>().matrix();
    Bin& bin = bins_[pack(cell)];
    bin.points += count;
    bin.sum += static_cast<float>(count) * (point.z() - static_cast<float>(cell.z()) * kBin);
}

std::vector<Surface> Columns::surfaces() const {
    std::vector<FilledBin> bins;
    bins.reserve(bins_.size());
    std::vector<VoxelKey> keys;
    keys.reserve(bins_.size());
    for (const auto& [key, bin] : bins_) keys.push_back(key);
    std::sort(keys.begin(), keys.end());  // by x, y, z, as they are packed
    for (const VoxelKey key : keys) {
        const Bin& bin = bins_.at(key);
        const Cell cell = unpack(key);
        bins.push_back(
            {cell, bin.points,
             static_cast<float>(cell.z()) * kBin + bin.sum / static_cast<float>(bin.points)});
    }
    std::vector<Surface> surfaces;
    for (std::size_t begin = 0, end = 0; begin < bins.size(); begin = end) {
        for (end = begin + 1; end < bins.size(); ++end) {
            const Cell &below = bins[end - 1].cell, &above = bins[end].cell;
            if (above.head<2>() != below.head<2>() || above.z() - below.z() > kGap) break;
        }
        surfaces.push_back(surface_of(bins.data() + begin, bins.data() + end));
    }
    return surfaces;
}

}  // namespace dynamic_filter::app
