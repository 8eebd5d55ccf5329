// SPDX-License-Identifier: MIT
#include "run/tile_map.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "base/little_endian.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter::app {

void Sightings::make_room(std::uint32_t voxel) {
    if (voxel < counts_.size()) return;
    const std::size_t size = std::size_t{voxel} + 1;
    counts_.resize(size);
    drives_.resize(size * words_);
    last_.resize(size);
}

void Sightings::add(const ScanOfDrive& scan, const std::vector<std::uint32_t>& voxels) {
    for (const std::uint32_t voxel : voxels) {
        if (voxel == kNoVoxel) continue;
        make_room(voxel);
        if (counts_[voxel] > 0 && last_[voxel] == scan) continue;
        if (counts_[voxel] == 0) ++seen_;
        last_[voxel] = scan;
        ++counts_[voxel];
        drives_[voxel * words_ + scan.drive / 32] |= 1U << scan.drive % 32;
    }
}

void Sightings::widen(std::size_t drives) {
    const std::size_t words = drive_words(drives);
    if (words == words_) return;
    std::vector<std::uint32_t> wide(counts_.size() * words);
    for (std::size_t v = 0; v < counts_.size(); ++v) {
        std::copy_n(&drives_[v * words_], words_, &wide[v * words]);
    }
    drives_ = std::move(wide);
    words_ = words;
}

void Sightings::archive(Archive& archive) {
    archive.value(words_);
    archive.value(seen_);
    archive.values(counts_);
    archive.values(drives_);
    last_.resize(counts_.size());
}

std::uint32_t Sightings::scans(std::uint32_t voxel) const {
    return voxel < counts_.size() ? counts_[voxel] : 0;
}

std::uint32_t Sightings::drives(std::uint32_t voxel, std::size_t word) const {
    return voxel < counts_.size() ? drives_[voxel * words_ + word] : 0;
}

io::Cloud empty_tile_map(std::size_t words) {
    io::Cloud map;
    for (const char* axis : {"x", "y", "z"}) io::add_field(map, axis, io::FieldType::f64);
    io::add_field(map, "probability", io::FieldType::f32);
    io::add_field(map, "scans", io::FieldType::u32);
    io::add_field(map, "sessions", io::FieldType::u32, static_cast<std::uint32_t>(words));
    return map;
}

void append(io::Cloud& map, const StaticVoxel& voxel, const Sightings& sightings) {
    for (const double coordinate : voxel.center) put(map.data, coordinate);
    put(map.data, voxel.probability);
    put(map.data, sightings.scans(voxel.voxel));
    for (std::size_t word = 0; word < sightings.words(); ++word) {
        put(map.data, sightings.drives(voxel.voxel, word));
    }
}

void append(io::Cloud& map, const io::Cloud& from, std::size_t first, std::size_t last) {
    // A record ends with the drives, whose words are zero for those that came later.
    for (std::size_t i = first; i < last; ++i) {
        const auto record = std::span(from.data).subspan(i * from.point_bytes, from.point_bytes);
        map.data.insert(map.data.end(), record.begin(), record.end());
        map.data.resize(map.data.size() + map.point_bytes - from.point_bytes);
    }
}

}  // namespace dynamic_filter::app
