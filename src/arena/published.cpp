// SPDX-License-Identifier: MIT
// Figures of others, as their publications print them. Where only a transcription was at hand, the
// source says "second hand".
#include <algorithm>

#include "arena/arena.hpp"

namespace dynamic_filter::app {

namespace {

/// A method and its figures, entry by entry, of one column of an arena [%].
struct PublishedRow {
    const char* arena;
    std::size_t column;
    const char* method;
    std::vector<std::pair<const char*, double>> figures;
    const char* how;
    const char* source;
};

// Kept wide: one row is one line of a publication's table.
// clang-format off
const std::vector<PublishedRow>& published_rows() {
    static const std::vector<PublishedRow> rows = {
        {"erasor", 2, "OctoMap, 0.2 m", {{"00", 51.4}, {"01", 34.4}, {"02", 38.4}, {"05", 50.6}, {"07", 55.2}}, "online", "ERASOR (RA-L 2021), Table II, second hand"},
        {"erasor", 2, "Removert, RM3", {{"00", 91.9}, {"01", 93.9}, {"02", 85.3}, {"05", 87.4}, {"07", 88.8}}, "offline", "ERASOR (RA-L 2021), Table II, second hand"},
        {"erasor", 2, "Removert, RM3 + RV1", {{"00", 88.7}, {"01", 71.5}, {"02", 85.8}, {"05", 83.9}, {"07", 88.3}}, "offline", "ERASOR (RA-L 2021), Table II, second hand"},
        {"erasor", 0, "Removert, RM3 + RV1", {{"00", 86.83}, {"01", 95.82}, {"02", 83.29}, {"05", 88.17}, {"07", 82.04}}, "offline", "ERASOR (RA-L 2021), Table II, second hand"},
        {"erasor", 1, "Removert, RM3 + RV1", {{"00", 90.62}, {"01", 57.08}, {"02", 88.37}, {"05", 79.98}, {"07", 95.50}}, "offline", "ERASOR (RA-L 2021), Table II, second hand"},
        {"erasor", 0, "ERASOR", {{"00", 93.98}, {"01", 91.49}, {"02", 87.73}, {"05", 88.73}, {"07", 90.62}}, "offline", "README of ERASOR"},
        {"erasor", 1, "ERASOR", {{"00", 97.08}, {"01", 95.38}, {"02", 97.01}, {"05", 98.26}, {"07", 99.27}}, "offline", "README of ERASOR"},
        {"erasor", 2, "ERASOR", {{"00", 95.5}, {"01", 93.4}, {"02", 92.1}, {"05", 93.3}, {"07", 94.8}}, "offline", "README of ERASOR"},
        {"erasor", 2, "ERASOR, tuned anew in 2026", {{"00", 95.7}, {"01", 93.3}, {"02", 92.8}, {"05", 93.2}, {"07", 96.3}}, "offline", "README of ERASOR"},
        {"erasor", 2, "MapCleaner", {{"00", 98.5}, {"01", 97.3}, {"02", 99.2}, {"05", 98.5}, {"07", 98.1}}, "offline", "MapCleaner (Remote Sensing 2022), second hand"},
        {"erasor", 2, "DR-REMOVER", {{"00", 98.3}, {"01", 97.0}, {"02", 96.4}, {"05", 99.1}, {"07", 97.1}}, "offline", "DR-REMOVER (T-IV 2024), second hand"},
        {"erasor", 2, "Raymoval", {{"00", 92.2}, {"01", 92.0}, {"02", 94.2}, {"05", 94.5}, {"07", 91.6}}, "offline", "arXiv 2605.08937, second hand"},
        {"erasor", 0, "DynamicFilter, in the paper", {{"00", 90.07}, {"01", 87.95}, {"02", 88.02}, {"05", 90.17}, {"07", 87.94}}, "online", "DynamicFilter, Table I"},
        {"erasor", 1, "DynamicFilter, in the paper", {{"00", 91.09}, {"01", 87.69}, {"02", 86.10}, {"05", 84.65}, {"07", 86.80}}, "online", "DynamicFilter, Table I"},
        {"erasor", 2, "DynamicFilter, in the paper", {{"00", 90.6}, {"01", 87.8}, {"02", 87.1}, {"05", 87.3}, {"07", 87.4}}, "online", "DynamicFilter, Table I"},
        {"erasor2", 2, "ERASOR2", {{"00", 98.6}, {"01", 94.3}, {"02", 99.0}, {"05", 98.3}, {"07", 98.8}}, "offline", "README of ERASOR2"},
        {"erasor2", 2, "ERASOR2, run anew in 2026", {{"00", 98.6}, {"01", 94.9}, {"02", 99.6}, {"05", 98.0}, {"07", 97.5}}, "offline", "README of ERASOR2"},
        {"strict", 2, "OctoMap", {{"02", 88.70}, {"07", 83.97}}, "online", "FreeDOM (RA-L 2025), Table I, second hand"},
        {"strict", 2, "Removert", {{"02", 95.37}, {"07", 70.74}}, "offline", "FreeDOM (RA-L 2025), Table I, second hand"},
        {"strict", 2, "ERASOR", {{"02", 97.60}, {"07", 95.18}}, "offline", "FreeDOM (RA-L 2025), Table I, second hand"},
        {"strict", 2, "DUFOMap", {{"02", 98.23}, {"07", 87.37}}, "online", "FreeDOM (RA-L 2025), Table I, second hand"},
        {"strict", 2, "FreeDOM", {{"02", 99.59}, {"07", 98.33}}, "online", "FreeDOM (RA-L 2025), Table I, second hand"},
        {"dynamicmap", 0, "Removert, port of the benchmark", {{"00", 99.44}, {"01", 97.81}, {"05", 99.42}, {"av2", 98.97}, {"semindoor", 99.96}}, "offline", "papers, second hand"},
        {"dynamicmap", 1, "Removert, port of the benchmark", {{"00", 41.53}, {"01", 39.56}, {"05", 22.28}, {"av2", 31.16}, {"semindoor", 12.15}}, "offline", "papers, second hand"},
        {"dynamicmap", 2, "Removert, port of the benchmark", {{"00", 64.26}, {"01", 62.20}, {"05", 47.06}, {"av2", 55.53}, {"semindoor", 34.85}}, "offline", "papers, second hand"},
        {"dynamicmap", 0, "ERASOR, port of the benchmark", {{"00", 66.70}, {"01", 98.12}, {"05", 69.40}, {"av2", 77.51}, {"semindoor", 94.90}}, "offline", "papers, second hand; the benchmark's page has 88.49 for av2"},
        {"dynamicmap", 1, "ERASOR, port of the benchmark", {{"00", 98.54}, {"01", 90.94}, {"05", 99.06}, {"av2", 99.18}, {"semindoor", 66.26}}, "offline", "papers, second hand; the benchmark's page has 88.49 for av2"},
        {"dynamicmap", 2, "ERASOR, port of the benchmark", {{"00", 81.07}, {"01", 94.46}, {"05", 82.92}, {"av2", 87.68}, {"semindoor", 79.30}}, "offline", "papers, second hand; the benchmark's page has 88.49 for av2"},
        {"dynamicmap", 0, "OctoMap, 0.1 m", {{"00", 68.05}, {"01", 55.55}, {"05", 66.28}, {"av2", 69.04}, {"semindoor", 88.97}}, "online", "papers, second hand"},
        {"dynamicmap", 1, "OctoMap, 0.1 m", {{"00", 99.69}, {"01", 99.59}, {"05", 99.24}, {"av2", 97.50}, {"semindoor", 82.18}}, "online", "papers, second hand"},
        {"dynamicmap", 2, "OctoMap, 0.1 m", {{"00", 82.37}, {"01", 74.38}, {"05", 81.10}, {"av2", 82.04}, {"semindoor", 85.51}}, "online", "papers, second hand"},
        {"dynamicmap", 0, "OctoMap, ground fitted", {{"00", 93.06}, {"01", 80.64}, {"05", 93.54}, {"av2", 81.51}, {"semindoor", 96.79}}, "online", "papers, second hand"},
        {"dynamicmap", 1, "OctoMap, ground fitted", {{"00", 98.67}, {"01", 97.27}, {"05", 92.48}, {"av2", 83.56}, {"semindoor", 73.50}}, "online", "papers, second hand"},
        {"dynamicmap", 2, "OctoMap, ground fitted", {{"00", 95.83}, {"05", 93.01}, {"av2", 82.53}, {"semindoor", 84.34}}, "online", "papers, second hand"},
        {"dynamicmap", 0, "Dynablox", {{"00", 96.76}, {"01", 96.33}, {"05", 97.80}, {"av2", 96.08}, {"semindoor", 98.81}}, "online", "papers, second hand"},
        {"dynamicmap", 1, "Dynablox", {{"00", 90.68}, {"01", 68.01}, {"05", 88.68}, {"av2", 92.87}, {"semindoor", 36.49}}, "online", "papers, second hand"},
        {"dynamicmap", 2, "Dynablox", {{"00", 93.67}, {"01", 80.94}, {"av2", 94.46}, {"semindoor", 60.05}}, "online", "papers, second hand"},
        {"dynamicmap", 0, "DeFlow", {{"00", 99.43}, {"01", 99.19}, {"05", 99.48}, {"av2", 99.54}, {"semindoor", 99.85}}, "trained", "papers, second hand"},
        {"dynamicmap", 1, "DeFlow", {{"00", 81.68}, {"01", 81.25}, {"05", 50.85}, {"av2", 30.22}, {"semindoor", 2.02}}, "trained", "papers, second hand"},
        {"dynamicmap", 2, "DeFlow", {{"00", 90.12}, {"05", 71.13}, {"av2", 54.85}, {"semindoor", 14.19}}, "trained", "papers, second hand"},
        {"dynamicmap", 0, "BeautyMap", {{"00", 96.76}, {"01", 99.17}, {"05", 96.34}, {"semindoor", 93.69}}, "offline", "BeautyMap (RA-L 2024), second hand"},
        {"dynamicmap", 1, "BeautyMap", {{"00", 98.38}, {"01", 92.99}, {"05", 98.29}, {"semindoor", 90.67}}, "offline", "BeautyMap (RA-L 2024), second hand"},
        {"dynamicmap", 2, "BeautyMap", {{"00", 97.57}}, "offline", "BeautyMap (RA-L 2024), second hand"},
        {"dynamicmap", 3, "BeautyMap", {{"00", 97.56}, {"01", 95.98}, {"05", 97.31}, {"semindoor", 92.16}}, "offline", "BeautyMap (RA-L 2024), second hand"},
        {"dynamicmap", 0, "DUFOMap", {{"00", 97.96}, {"01", 98.09}, {"av2", 96.67}, {"semindoor", 99.64}}, "online", "DUFOMap (RA-L 2024), second hand"},
        {"dynamicmap", 1, "DUFOMap", {{"00", 98.72}, {"01", 94.20}, {"av2", 88.90}, {"semindoor", 83.00}}, "online", "DUFOMap (RA-L 2024), second hand"},
        {"dynamicmap", 2, "DUFOMap", {{"00", 98.34}, {"01", 96.12}, {"av2", 92.70}, {"semindoor", 90.94}}, "online", "DUFOMap (RA-L 2024), second hand"},
        {"dynamicmap", 0, "dor_numpy", {{"00", 98.9}, {"05", 98.0}}, "offline", "the benchmark's pull request 28, open"},
        {"dynamicmap", 1, "dor_numpy", {{"00", 98.3}, {"05", 98.1}}, "offline", "the benchmark's pull request 28, open"},
        {"dynamicmap", 2, "dor_numpy", {{"00", 98.6}, {"05", 98.0}}, "offline", "the benchmark's pull request 28, open"},
        {"dynamicmap", 0, "4dNDF", {{"00", 99.46}, {"05", 99.54}, {"av2", 99.17}}, "offline", "4dNDF (CVPR 2024), second hand"},
        {"dynamicmap", 1, "4dNDF", {{"00", 98.47}, {"05", 98.36}, {"av2", 95.91}}, "offline", "4dNDF (CVPR 2024), second hand"},
        {"dynamicmap", 2, "4dNDF", {{"00", 98.97}, {"05", 98.95}, {"av2", 97.53}}, "offline", "4dNDF (CVPR 2024), second hand"},
        {"doals", 0, "Dynablox", {{"station", 87.3}, {"shopville", 87.8}, {"hauptgebaeude", 86.0}, {"niederdorf", 83.1}}, "online", "README of HMM-MOS"},
        {"doals", 1, "Dynablox", {{"station", 86.2}, {"shopville", 83.2}, {"hauptgebaeude", 84.1}, {"niederdorf", 81.6}}, "online", "README of HMM-MOS"},
        {"doals", 0, "HMM-MOS", {{"station", 88.7}, {"shopville", 84.0}, {"hauptgebaeude", 87.3}, {"niederdorf", 82.9}}, "online", "its README"},
        {"doals", 1, "HMM-MOS", {{"station", 81.9}, {"shopville", 81.6}, {"hauptgebaeude", 85.6}, {"niederdorf", 80.9}}, "online", "its README"},
        {"doals", 1, "4DMOS", {{"station", 38.8}, {"shopville", 50.6}, {"hauptgebaeude", 71.1}, {"niederdorf", 40.2}}, "trained", "README of HMM-MOS"},
        {"mos", 0, "4DMOS", {{"08", 77.2}}, "trained", "4DMOS, issue 24"},
        {"mos", 0, "MF-MOS", {{"08", 76.12}}, "trained", "README of MF-MOS"},
        {"mos", 0, "KDMOS", {{"08", 79.4}}, "trained", "KDMOS, name of its weights"},
        {"mos", 0, "MapMOS", {{"08", 86.1}}, "trained", "MapMOS, issue 16"},
        {"helimos", 0, "4DMOS", {{"Avia", 52.1}, {"Aeva", 54.0}, {"Ouster", 64.2}, {"Velodyne", 4.7}}, "trained", "README of HMM-MOS"},
        {"helimos", 0, "MapMOS", {{"Avia", 58.9}, {"Aeva", 63.2}, {"Ouster", 81.4}, {"Velodyne", 4.3}}, "trained", "README of HMM-MOS"},
        {"helimos", 0, "HMM-MOS", {{"Avia", 51.9}, {"Aeva", 69.0}, {"Ouster", 74.2}, {"Velodyne", 36.0}}, "online", "README of HMM-MOS; may be of all labelled scans"},
        {"moe", 0, "DOD", {{"00", 78.6}, {"01", 14.2}, {"02", 59.5}}, "online", "README of MOE; tuned for each sequence"},
        {"moe", 0, "InsMOS", {{"00", 49.5}, {"01", 28.2}, {"02", 37.9}}, "trained", "README of MOE"},
        {"moe", 0, "HMM-MOS, one setting", {{"00", 80.0}, {"01", 38.2}, {"02", 81.9}}, "online", "README of HMM-MOS"},
        {"moe", 0, "HMM-MOS, two settings", {{"00", 80.0}, {"01", 40.5}, {"02", 81.9}}, "online", "README of HMM-MOS"}};
    return rows;
}

// clang-format on

}  // namespace

std::vector<PublishedFigure> published_figures(const std::string& arena, const std::string& entry) {
    std::vector<PublishedFigure> found;
    for (const PublishedRow& row : published_rows()) {
        const bool is_of_it = row.arena == arena || arena == std::string(row.arena) + "-kitti";
        if (!is_of_it) continue;
        for (const auto& [name, percent] : row.figures) {
            if (name != group_of_entry(entry)) continue;
            const auto same = std::find_if(found.begin(), found.end(), [&](const auto& figure) {
                return figure.method == row.method && figure.source == row.source;
            });
            PublishedFigure& figure =
                same != found.end()
                    ? *same
                    : found.emplace_back(PublishedFigure{
                          name, row.method, ArenaScores(arena_of(arena).columns.size()), row.how,
                          row.source});
            figure.scores[row.column] = percent / 100.0;
        }
    }
    return found;
}

}  // namespace dynamic_filter::app
