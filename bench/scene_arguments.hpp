// SPDX-License-Identifier: MIT
/// The scene that a measuring program simulates, from its arguments.
#pragma once

#include <span>
#include <string_view>

#include "bench/parse_number.hpp"
#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter {

constexpr std::size_t kSceneArguments = 5;

/// Of the first arguments SCENE SENSOR SEED FRAMES RATE. Throws ConfigError.
inline sim::SimulationOptions scene_of(std::span<const std::string_view> words) {
    sim::SimulationOptions options;
    options.scene = words[0];
    options.sensor = words[1];
    options.seed = parse<std::uint64_t>("SEED", words[2]);
    options.frames = parse<std::size_t>("FRAMES", words[3]);
    options.rate_hz = parse<double>("RATE", words[4]);
    return options;
}

}  // namespace dynamic_filter
