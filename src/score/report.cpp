// SPDX-License-Identifier: MIT
#include "score/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace dynamic_filter::app {

using nlohmann::ordered_json;

namespace {

ordered_json json_of(const std::map<std::string, eval::VoxelScore>& scores) {
    ordered_json json;
    for (const auto& [reading, s] : scores) {
        json[reading] = {
            {"pr", share_or_null(s.pr)}, {"rr", share_or_null(s.rr)}, {"f1", share_or_null(s.f1)}};
    }
    return json;
}

std::string rows_of(const std::map<std::string, eval::VoxelScore>& scores, const char* grid) {
    std::string text;
    for (const auto& [reading, s] : scores) {
        text += fmt::format("  {:<24} {:>7} {:>7} {:>6}\n", reading + grid, percent(s.pr),
                            percent(s.rr), three_digits(s.f1));
    }
    return text;
}

}  // namespace

ordered_json share_or_null(const std::optional<double>& share) {
    return share ? ordered_json(*share) : ordered_json(nullptr);
}

ordered_json to_json(const eval::Scores& scores) {
    ordered_json json;
    if (!scores.voxel.empty()) json["voxel"] = json_of(scores.voxel);
    if (!scores.voxel_shifted.empty()) json["voxel_shifted"] = json_of(scores.voxel_shifted);
    const auto& p = scores.point;
    json["point"] = {{"sa", share_or_null(p.sa)},
                     {"da", share_or_null(p.da)},
                     {"aa", share_or_null(p.aa)},
                     {"ha", share_or_null(p.ha)},
                     {"iou", share_or_null(p.iou)}};
    json["dynamic_voxel_share"] = scores.dynamic_share;
    return json;
}

ordered_json to_json(const StageTimes& times) {
    ordered_json json = ordered_json::object();
    constexpr double kMs = 1e3;
    for (const auto& [stage, calls] : times) {
        if (calls.count() == 0) continue;
        json[stage] = {{"count", calls.count()},
                       {"mean", kMs * calls.total() / static_cast<double>(calls.count())},
                       {"p50", kMs * calls.quantile(0.50)},
                       {"p95", kMs * calls.quantile(0.95)},
                       {"p99", kMs * calls.quantile(0.99)},
                       {"max", kMs * calls.max()}};
    }
    return json;
}

std::string text_of(const ordered_json& json) {
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string percent(const std::optional<double>& fraction) {
    return fraction ? fmt::format("{:.2f}", 100.0 * *fraction) : "-";
}

std::string three_digits(const std::optional<double>& value) {
    return value ? fmt::format("{:.3f}", *value) : "-";
}

std::string table(const eval::Scores& scores) {
    std::string text =
        fmt::format("  {:<24} {:>7} {:>7} {:>6}\n", "mixed voxels", "PR [%]", "RR [%]", "F1");
    text += rows_of(scores.voxel, "") + rows_of(scores.voxel_shifted, ", shifted");
    const auto& p = scores.point;
    text += fmt::format("  points: SA {}  DA {}  AA {}  HA {}  moving IoU {}\n", percent(p.sa),
                        percent(p.da), percent(p.aa), percent(p.ha), percent(p.iou));
    return text;
}

}  // namespace dynamic_filter::app
