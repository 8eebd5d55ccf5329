// SPDX-License-Identifier: MIT
#include "score/knowable_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "score/report.hpp"

namespace dynamic_filter::app {

using nlohmann::ordered_json;

namespace {

void put_removed(ordered_json& json, const eval::Removed& removed) {
    json["points"] = removed.points;
    json["points_removed"] = share_or_null(removed.point_share());
    json["voxels"] = removed.voxels;
    json["rr"] = share_or_null(removed.rr());
}

}  // namespace

ordered_json to_json(const eval::KnowableScores& scores) {
    ordered_json json{{"groups", ordered_json::object()}, {"bins", ordered_json::array()}};
    const auto groups = eval::knowable_groups();
    for (std::size_t g = 0; g < groups.size(); ++g) {
        put_removed(json["groups"][groups[g].name], scores.groups[g]);
    }
    for (std::size_t b = 0; b < scores.bins.size(); ++b) {
        const bool is_last = b + 1 == scores.bins.size();
        ordered_json bin{
            {"from", eval::kBeamBins[b]},
            {"to", is_last ? ordered_json(nullptr) : ordered_json(eval::kBeamBins[b + 1] - 1)}};
        put_removed(bin, scores.bins[b]);
        json["bins"].push_back(std::move(bin));
    }
    return json;
}

std::string table(const eval::KnowableScores& scores) {
    std::string text = fmt::format("  {:<28} {:>10} {:>11} {:>9} {:>7}\n", "what is dynamic",
                                   "points", "removed [%]", "voxels", "RR [%]");
    const auto groups = eval::knowable_groups();
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const eval::Removed& removed = scores.groups[g];
        text += fmt::format("  {:<28} {:>10} {:>11} {:>9} {:>7}\n", groups[g].title, removed.points,
                            percent(removed.point_share()), removed.voxels, percent(removed.rr()));
    }
    return text;
}

}  // namespace dynamic_filter::app
