// SPDX-License-Identifier: MIT
/// Measures the inner loops, and compares each with the limit of this machine (roofline model). The
/// limit is the longer of two times: that of its memory traffic at the rate of a copy, and that of
/// its arithmetic at the rate of multiply-adds. One thread. The data are those of a 64-beam sensor;
/// they do not fit into the cache if they do not fit in real use.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/range_image.hpp"
#include "filter/evidence_map.hpp"
#include "filter/line_of_sight.hpp"
#include "filter/vote.hpp"
#include "geometry/map_points.hpp"

namespace {

using namespace dynamic_filter;
using Clock = std::chrono::steady_clock;

double seconds_of(const auto& work) {
    const auto start = Clock::now();
    work();
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The best of a few runs, which shows the limit of the machine.
double best_seconds_of(const auto& work) {
    double best = 1e9;
    for (int i = 0; i < 7; ++i) best = std::min(best, seconds_of(work));
    return best;
}

/// Bytes per second, read and written, of a copy that does not fit into the cache.
double copy_rate() {
    static const double rate = [] {
        std::vector<char> from(std::size_t{256} << 20, 1), to(from.size());
        const double s = best_seconds_of([&] {
            std::memcpy(to.data(), from.data(), from.size());
            benchmark::DoNotOptimize(to.data());
        });
        return 2.0 * static_cast<double>(from.size()) / s;
    }();
    return rate;
}

/// Floating-point operations per second of independent multiply-adds with the widest vectors.
#ifdef __x86_64__
__attribute__((target_clones("avx512f", "arch=haswell", "default")))
#endif
double
multiply_add(int rounds) {
    constexpr int kChains = 10, kLanes = 16;
    float a[kChains][kLanes];
    for (int c = 0; c < kChains; ++c) {
        for (int k = 0; k < kLanes; ++k) a[c][k] = static_cast<float>(c + k);
    }
    for (int r = 0; r < rounds; ++r) {
        for (auto& chain : a) {
            for (float& x : chain) x = __builtin_fmaf(x, 0.999F, 0.001F);
        }
    }
    double sum = 0.0;
    for (const auto& chain : a) {
        for (const float x : chain) sum += static_cast<double>(x);
    }
    benchmark::DoNotOptimize(sum);
    return 2.0 * rounds * kChains * kLanes;
}
double arithmetic_rate() {
    static const double rate = [] {
        double operations = 0.0;
        const double s = best_seconds_of([&] { operations = multiply_add(2'000'000); });
        return operations / s;
    }();
    return rate;
}

/// Cost per item: bytes that must be moved, and floating-point operations counted in the source.
struct Cost {
    double bytes, operations;
};

void report(benchmark::State& state, std::size_t items, Cost cost) {
    const auto count = static_cast<double>(items) * static_cast<double>(state.iterations());
    state.counters["items/s"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
    const double least = std::max(cost.bytes / copy_rate(), cost.operations / arithmetic_rate());
    state.counters["roofline"] = benchmark::Counter(count * least, benchmark::Counter::kIsRate);
}

/// A hall with pillars, seen by 64 beams x 2048 columns.
Points scan() {
    Points points;
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0.0F, 0.02F);
    for (int c = 0; c < 2048; ++c) {
        for (int r = 0; r < 64; ++r) {
            const float a =
                2.0F * std::numbers::pi_v<float> * (static_cast<float>(c) + 0.5F) / 2048.0F;
            const float e = (-22.5F + 45.0F * static_cast<float>(r) / 63.0F) *
                            std::numbers::pi_v<float> / 180.0F;
            const Point ray(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
            float range = 40.0F / std::max(std::abs(ray.x()), 1.6F * std::abs(ray.y()));
            if (ray.z() < 0.0F) range = std::min(range, 1.8F / -ray.z());
            if (ray.z() > 0.0F) range = std::min(range, 8.0F / ray.z());
            if (c % 100 < 12) range = std::min(range, 6.0F + static_cast<float>(c) / 100.0F);
            points.push_back((range + noise(random)) * ray);
        }
    }
    return points;
}
const Points& points() {
    static const Points all = scan();
    return all;
}
BeamPattern pattern() {
    return {2.0F * std::numbers::pi_v<float> / 2048.0F,
            45.0F / 63.0F * std::numbers::pi_v<float> / 180.0F};
}
Eigen::Isometry3f a_step_on() {
    Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
    T.translation() = Point(0.5F, 0.1F, 0.0F);
    T.linear() = Eigen::AngleAxisf(0.02F, Point::UnitZ()).toRotationMatrix();
    return T;
}

void to_spherical_of_a_scan(benchmark::State& state) {
    Directions out;
    for (auto _ : state) to_spherical(points(), a_step_on(), out);
    report(state, points().size(), {12 + 12, 18 + 2 * 22 + 10});
}
BENCHMARK(to_spherical_of_a_scan);

void project_of_a_scan(benchmark::State& state) {
    const BeamPattern p = pattern();
    const ImageGrid grid = make_grid(p.azimuth_spacing, p.elevation_spacing, -0.5F, 0.5F);
    Projection out;
    for (auto _ : state) project(points(), a_step_on(), grid, out);
    report(state, points().size(), {12 + 8, 18 + 2 * 22 + 14});
}
BENCHMARK(project_of_a_scan);

void to_voxels_of_a_scan(benchmark::State& state) {
    MapPoints out;
    for (auto _ : state) to_voxels(points(), a_step_on().cast<double>(), 0.2F, out);
    report(state, points().size(), {12 + 12 + 8, 18 + 3 * 5 + 5});
}
BENCHMARK(to_voxels_of_a_scan);

void voxel_index_insert(benchmark::State& state) {
    MapPoints in_map;
    to_voxels(points(), Pose::Identity(), 0.2F, in_map);
    VoxelIndex index;
    std::vector<std::uint32_t> voxels(in_map.keys.size());
    for (auto _ : state) {
        index.insert(in_map.keys, voxels);
        benchmark::DoNotOptimize(voxels.data());
    }
    report(state, in_map.keys.size(), {8 + 4, 0});
}
BENCHMARK(voxel_index_insert);

void beam_image(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(BeamImage(points(), pattern()).bytes());
    report(state, points().size(), {12 + 6, 2 * (2 * 22 + 10)});
}
BENCHMARK(beam_image);

/// Places between 2 and 40 m; half of them lie on surfaces that the sensor sees.
void lines_of_sight(benchmark::State& state) {
    const BeamImage image(points(), pattern());
    Points places;
    for (std::size_t i = 0; i < points().size(); i += 2) {
        places.push_back(points()[i]);
        places.push_back(points()[i + 1] * (0.4F + 0.7F * static_cast<float>(i % 97) / 97.0F));
    }
    Directions seen;
    to_spherical(places, a_step_on(), seen);
    std::vector<Sight> sights;
    const Config config;
    const SightMargins margins = margins_of(config.scans.sight, config.map.voxel_size);
    for (auto _ : state) {
        check_lines_of_sight(image, seen, margins, sights);
        benchmark::DoNotOptimize(sights.data());
    }
    // Mean of this mixture, counted by hand: 30 % of the places need one beam, the others nine or
    // more.
    report(state, places.size(), {12 + 1 + 4, 60 + 0.7 * (9 * 45 + 120)});
}
BENCHMARK(lines_of_sight);

/// The votes on all voxels of a map of ten scans, including the search for the voters.
void occupancy_of_a_map(benchmark::State& state) {
    with_threads(1, [&] {
        Config config;
        EvidenceMap map(config);
        StageTimes times;
        for (int i = 0; i < 10; ++i) {
            Scan s{points(), Pose::Identity(), 0.3 * i, static_cast<std::size_t>(i)};
            map.insert(s, times);
            map.observe_elsewhere(times);
        }
        std::vector<std::uint32_t> all(map.grid().size());
        for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
        for (auto _ : state)
            benchmark::DoNotOptimize(occupancy_of(map.grid(), all, config.scans).data());
        // About 100 voters per voxel, with 20 operations each.
        report(state, all.size(), {36, 100 * 20});
    });
}
BENCHMARK(occupancy_of_a_map)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    benchmark::AddCustomContext("copy", std::to_string(copy_rate() / 1e9) + " GB/s");
    benchmark::AddCustomContext("multiply-add",
                                std::to_string(arithmetic_rate() / 1e9) + " Gflop/s");
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
