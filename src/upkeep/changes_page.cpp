// SPDX-License-Identifier: MIT
#include "upkeep/changes_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/json_vector.hpp"
#include "draw/canvas.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;

/// Calls f("went" or "came", number, change) for all, in the order of the files.
template <class F>
void each_change(const ChangesOfMap& changes, F&& f) {
    for (std::size_t i = 0; i < changes.went.size(); ++i) f("went", i + 1, changes.went[i]);
    for (std::size_t i = 0; i < changes.came.size(); ++i) f("came", i + 1, changes.came[i]);
}

}  // namespace

std::string changes_csv(const ChangesOfMap& changes) {
    std::string text = "change,number,x,y,z,size_x,size_y,size_z,points,scans,first,last\n";
    each_change(changes, [&](const char* what, std::size_t number, const Change& c) {
        const Eigen::Vector3d center = c.box.center(), size = c.box.sizes();
        text += fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.2f},{:.2f},{:.2f},{},{},{:.3f},{:.3f}\n",
                            what, number, center.x(), center.y(), center.z(), size.x(), size.y(),
                            size.z(), c.points(), c.scans, c.first, c.last);
    });
    return text;
}

std::string changes_json(const ChangesOfMap& changes) {
    Json rows = Json::array();
    each_change(changes, [&](const char* what, std::size_t number, const Change& c) {
        rows.push_back({{"change", what},
                        {"number", number},
                        {"center", array_of(rounded(c.box.center()))},
                        {"size", array_of(rounded(c.box.sizes()))},
                        {"points", c.points()},
                        {"scans", c.scans},
                        {"first", c.first},
                        {"last", c.last}});
    });
    const Json json = {{"went", changes.went.size()},
                       {"came", changes.came.size()},
                       {"voxels",
                        {{"seen_at_both", changes.voxels.at_both},
                         {"old_only", changes.voxels.old_only},
                         {"new_only", changes.voxels.new_only}}},
                       {"changes", std::move(rows)}};
    return json.dump(1) + "\n";
}

std::string changes_page(const ChangesOfMap& changes) {
    std::string text = fmt::format(
        R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><title>What changed</title>
<style>body{{font:15px/1.4 system-ui,sans-serif;margin:2em}}table{{border-collapse:collapse}}
td,th{{padding:.3em .8em;text-align:right;border-bottom:1px solid #ddd}}
#dates{{position:relative;max-width:1600px}}#dates img{{width:100%;display:block}}
#new{{position:absolute;top:0;left:0;clip-path:inset(0 0 0 50%)}}
input{{width:100%;max-width:1600px}}</style>
<h1>What changed: {} went, {} came</h1>
<p>Left of the line is the old date, with what went in red; right of it the new date, with what came in green.
<p><input type="range" min="0" max="100" value="50" aria-label="old and new"
 oninput="document.getElementById('new').style.clipPath='inset(0 0 0 '+this.value+'%)'">
<div id="dates"><img src="old.png" alt="the old date from above"><img id="new" src="new.png"
 alt="the new date from above"></div>
<p>Seen at both dates: {} voxels. Seen at the old date only: {}; at the new date only: {}. Of those, nobody can tell
whether they changed (<code>unseen.pcd</code>).
<table><tr><th>change<th>number<th>x, y, z [m]<th>size [m]<th>points<th>scans</tr>
)",
        changes.went.size(), changes.came.size(), changes.voxels.at_both, changes.voxels.old_only,
        changes.voxels.new_only);
    each_change(changes, [&](const char* what, std::size_t number, const Change& c) {
        const Eigen::Vector3d center = c.box.center(), size = c.box.sizes();
        text += fmt::format(
            "<tr><td>{}<td>{}<td>{:.1f}, {:.1f}, {:.1f}<td>{:.1f}, {:.1f}, {:.1f}<td>{}<td>{}"
            "</tr>\n",
            what, number, center.x(), center.y(), center.z(), size.x(), size.y(), size.z(),
            c.points(), c.scans);
    });
    return text + "</table>\n</html>\n";
}

io::Image date_from_above(const Points& kept, const Points& changed, const Eigen::AlignedBox3f& box,
                          const io::Color& color) {
    constexpr int kWidth = 1600, kHeight = 1200;  // [pixels]
    constexpr io::Color kPaper{250, 250, 250}, kStill{190, 195, 200};
    Canvas canvas(kWidth, kHeight, from_above(box, static_cast<float>(kWidth) / kHeight));
    canvas.draw(kept, 1.0F, [&](std::size_t) { return kStill; });
    // Above all else, so that no tree hides them.
    Points raised = changed;
    for (Point& point : raised) point.z() = box.max().z();
    canvas.draw(raised, 2.5F, [&](std::size_t) { return color; });
    return canvas.picture(kPaper);
}

}  // namespace dynamic_filter::app
