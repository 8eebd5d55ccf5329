// SPDX-License-Identifier: MIT
#include "run/filter_tiles.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <exception>
#include <mutex>
#include <thread>

#include "base/progress.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "filter/voxel_bytes.hpp"
#include "run/run.hpp"
#include "run/tile_file.hpp"

namespace dynamic_filter::app {

namespace {

constexpr double kGigabyte = 1e9, kMegabyte = 1e6;

// [bytes] Measured, see docs/city.md: of the image of a keyframe per point of a scan, and of the
// program and the scans that are read ahead.
constexpr std::size_t kBytesPerPoint = 9, kBytesOfProgram = 150'000'000;
// [bytes] Of a voxel, in the evidence that a run keeps.
constexpr std::size_t kEvidenceBytes = 100;

std::size_t halo_of(const TileWork& work) {
    if (work.tile.is_whole) return 0;
    const double cells = cells_of(work.tile.level);
    const double with_halo = cells + 2.0 * kHaloVoxels / kVoxelsPerCell;
    const double share = with_halo * with_halo / (cells * cells) - 1.0;
    // Voxels lie along the streets, so less than the area is added.
    return static_cast<std::size_t>(0.5 * share * static_cast<double>(work.voxels));
}

/// Smaller tiles help only where the tile, not the program, takes most of the memory.
[[noreturn]] void refuse_memory(std::size_t tile, std::size_t most_voxels) {
    const bool smaller_helps = tile > kBytesOfProgram && most_voxels >= 2 * kFewestTileVoxels;
    throw ConfigError(fmt::format(
        "a process with the largest tile needs about {:.2f} GB, which is more than --memory "
        "allows; give more{}",
        static_cast<double>(process_memory(tile)) / kGigabyte,
        smaller_helps
            ? fmt::format(", or make the tiles smaller: --tile-voxels {}", most_voxels / 2)
            : ""));
}

}  // namespace

std::size_t memory_of(const TileWork& work, const Plan& plan, const Config& config) {
    std::size_t points = 0;
    for (const PlannedDrive& drive : plan.drives) points = std::max(points, drive.most_points);
    const auto images = static_cast<std::size_t>(config.scans.max_keyframes);
    return kTileVoxelBytes * (work.voxels + halo_of(work)) +
           kBytesPerPoint * points * std::min(work.scans.size(), images);
}

std::size_t process_memory(std::size_t tile) { return kBytesOfProgram + tile; }

std::size_t memory_limit_of(const std::string& text) {
    if (text.empty()) {
        return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
               static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / 2;
    }
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [unit, error] = std::from_chars(text.data(), end, value);
    const std::string_view rest(unit, static_cast<std::size_t>(end - unit));
    const double factor = rest == "G" ? kGigabyte : rest == "M" ? kMegabyte : rest.empty() ? 1 : 0;
    if (error == std::errc{} && value * factor >= kMegabyte) {
        return static_cast<std::size_t>(value * factor);
    }
    throw ConfigError("--memory " + text +
                      ": expected a size such as 1.5G or 800M, or a number of bytes");
}

std::size_t tiles_at_a_time(const Job& job, const std::vector<std::size_t>& tiles,
                            const Effort& effort) {
    std::size_t largest = 1;
    for (const std::size_t t : tiles) {
        const TileWork& tile = job.plan.tiles[t];
        const std::size_t kept = job.keeps_evidence ? kEvidenceBytes * tile.voxels : 0;
        largest = std::max(largest, memory_of(tile, job.plan, job.config) + kept);
    }
    const auto threads =
        static_cast<std::size_t>(effort.threads > 0 ? effort.threads : available_threads());
    const std::size_t fit =
        effort.memory > kBytesOfProgram ? (effort.memory - kBytesOfProgram) / largest : 0;
    if (fit == 0) refuse_memory(largest, job.plan.most_voxels);
    return std::min({threads, fit, std::max<std::size_t>(1, tiles.size())});
}

bool filter_tiles(const Job& job, const std::vector<std::size_t>& tiles, std::size_t at_a_time,
                  const std::filesystem::path& folder, Workers& workers, const Effort& effort) {
    const int threads = effort.threads > 0 ? effort.threads : available_threads();
    Progress progress("tiles", tiles.size(), effort.quiet);
    std::mutex lock;
    std::exception_ptr failure;
    std::atomic<bool> stops = false;
    const auto work = [&] {
        while (const auto next = workers.next(tiles.size())) {
            if (stops || interrupted()) return;
            const TileWork& tile = job.plan.tiles[tiles[*next]];
            if (!is_done(folder / tile_file(tile.tile), job.mark)) {
                if (!filter_tile(job, tile, folder)) return;
            }
            const std::lock_guard hold(lock);
            progress.advance();
        }
    };
    const auto guarded = [&] {
        try {
            with_threads(std::max(1, threads / static_cast<int>(at_a_time)), work);
        } catch (...) {
            const std::lock_guard hold(lock);
            if (!failure) failure = std::current_exception();
            stops = true;
        }
    };
    {
        std::vector<std::jthread> crew;
        for (std::size_t i = 0; i < at_a_time; ++i) crew.emplace_back(guarded);
    }
    if (failure) std::rethrow_exception(failure);
    return !interrupted();
}

}  // namespace dynamic_filter::app
