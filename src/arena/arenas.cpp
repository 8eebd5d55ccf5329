// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "arena/arena.hpp"
#include "arena/rows.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

const std::vector<Arena>& arenas() {
    static const std::vector<Arena> all = [] {
        std::vector<Arena> rows = map_arenas();
        for (Arena& arena : moving_arenas()) rows.push_back(std::move(arena));
        rows.push_back(nuscenes_arena());
        rows.push_back(kitti_raw_arena());
        return rows;
    }();
    return all;
}

std::vector<std::string> arena_names() {
    std::vector<std::string> names;
    for (const Arena& arena : arenas()) names.push_back(arena.name);
    return names;
}

const Arena& arena_of(const std::string& name) {
    for (const Arena& arena : arenas()) {
        if (arena.name == name) return arena;
    }
    throw ConfigError(
        fmt::format("unknown arena '{}'; choose one of {}", name, fmt::join(arena_names(), ", ")));
}

std::string group_of_entry(const std::string& entry) { return entry.substr(0, entry.find('/')); }

}  // namespace dynamic_filter::app
