// SPDX-License-Identifier: MIT
#include "filter/label.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <tsl/robin_set.h>

#include "dynamic_filter/parallel.hpp"
#include "filter/vote.hpp"

namespace dynamic_filter {

namespace {

constexpr float kSteps = 255.0F;               // of a stored probability
constexpr std::size_t kPointsAtATime = 16384;  // number of points that a thread takes at a time

template <class Use>
void each_within(const EvidenceGrid& grid, int cells, std::uint32_t voxel, const Use& use) {
    grid.neighbors().each_within(grid.voxels(), cells, voxel, use);
}

/// `label` gives the label of a voxel.
template <class LabelOf>
bool touches_dynamic(std::uint32_t voxel, const LabelOf& label, const EvidenceGrid& grid) {
    bool touches = false;
    each_within(grid, 1, voxel,
                [&](std::uint32_t v, int) { touches |= label(v) == Label::dynamic; });
    return touches;
}

/// The static surface in a voxel that touches a dynamic one.
template <class LabelOf>
std::optional<ContactSurface> contact_of(std::uint32_t voxel, const LabelOf& label,
                                         const EvidenceGrid& grid,
                                         const ScansConfig::Contact& config) {
    std::vector<VoxelVerdict> around;
    each_within(grid, 2, voxel, [&](std::uint32_t v, int distance) {
        around.push_back({grid[v].centroid, label(v), distance});
    });
    return contact_surface(around, config);
}

bool is_above(const ContactSurface& surface, const Point& p, const ScansConfig::Contact& config) {
    const float least = std::max(static_cast<float>(config.height),
                                 static_cast<float>(config.roughness) * surface.roughness);
    return surface.height(p) > least;
}

/// The surfaces of those of the voxels that have one. Runs in parallel.
template <class LabelOf>
Contacts contacts_of(std::span<const std::uint32_t> voxels, const LabelOf& label,
                     const EvidenceGrid& grid, const ScansConfig::Contact& config) {
    std::vector<std::optional<ContactSurface>> surfaces(voxels.size());
    parallel_for(voxels.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            surfaces[i] = contact_of(voxels[i], label, grid, config);
        }
    });
    Contacts contacts;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (surfaces[i]) contacts[voxels[i]] = *surfaces[i];
    }
    return contacts;
}

/// Points above the surface of their voxel become dynamic; `point(i)` is in the map frame. Voxels
/// that are not `touched(voxel)` have no surface.
template <class Touched, class PointAt>
void label_above(const Contacts& contacts, const PointVoxels& voxels, const Touched& touched,
                 const ScansConfig::Contact& config, const PointAt& point, Labels& labels) {
    if (contacts.empty()) return;
    const auto is_above_its_surface = [&](std::size_t i) {
        if (labels[i] == Label::dynamic || voxels[i] == kNoVoxel || !touched(voxels[i])) {
            return false;
        }
        const auto surface = contacts.find(voxels[i]);
        return surface != contacts.end() && is_above(surface->second, point(i), config);
    };
    parallel_for(labels.size(), kPointsAtATime, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (is_above_its_surface(i)) labels[i] = Label::dynamic;
        }
    });
}

/// Indices of points of static voxels that lie above the surface of their voxel.
std::vector<std::size_t> points_above(const LocatedScan& scan, const VoxelDecisions& decided,
                                      const Labels& labels, const ScansConfig::Contact& config) {
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] != Label::static_ || !decided.voxels[scan.voxels[i]].has_contact) continue;
        const ContactSurface& contact = decided.contacts.at(scan.voxels[i]);
        if (is_above(contact, scan.in_map.points[i], config)) above.push_back(i);
    }
    return above;
}

}  // namespace

bool InstantLabels::is_due(const Said& said, const EvidenceGrid::State& state) const {
    const bool same =
        std::abs(state.score - said.score) <= static_cast<float>(config_.vote.ask_again);
    if (!same) return true;
    return said.label == Label::unknown && !is_unknown(state.evidence);
}

Verdict InstantLabels::label(std::size_t index, const PointVoxels& voxels,
                             const EvidenceGrid& grid) {
    said_.resize(grid.size());
    std::vector<std::uint32_t> due;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        constexpr std::size_t kAhead = 16;  // number of points for which voxels are prefetched
        if (i + kAhead < voxels.size() && voxels[i + kAhead] != kNoVoxel) {
            __builtin_prefetch(&grid[voxels[i + kAhead]]);
            __builtin_prefetch(&said_[voxels[i + kAhead]]);
        }
        const std::uint32_t voxel = voxels[i];
        if (voxel == kNoVoxel || !is_due(said_[voxel], grid[voxel])) continue;
        // Temporary label, so that the voxel is listed only once.
        said_[voxel] = {grid[voxel].score, Label::static_, 0, Role::none};
        due.push_back(voxel);
    }
    const auto occupancy = occupancy_of(grid, due, config_);
    for (std::size_t i = 0; i < due.size(); ++i) {
        said_[due[i]].label = label_of(occupancy[i], threshold_);
        said_[due[i]].probability =
            static_cast<std::uint8_t>(std::lround(kSteps * occupancy[i].value_or(0.0F)));
    }
    Verdict verdict{index, Labels(voxels.size(), Label::unknown),
                    std::vector<float>(voxels.size(), 0.0F)};
    parallel_for(voxels.size(), kPointsAtATime, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (voxels[i] == kNoVoxel) continue;
            const Said& said = said_[voxels[i]];
            verdict.labels[i] = said.label;
            verdict.probability[i] = static_cast<float>(said.probability) / kSteps;
        }
    });
    return verdict;
}

/// The voxels of the scan that hold dynamic points, and those that touch them.
std::vector<std::uint32_t> InstantLabels::find_touched(const PointVoxels& voxels,
                                                       const Labels& labels,
                                                       const EvidenceGrid& grid) {
    for (const std::uint32_t voxel : in_roles_) said_[voxel].role = Role::none;
    in_roles_.clear();
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] != Label::dynamic || said_[voxels[i]].role != Role::none) continue;
        said_[voxels[i]].role = Role::moving;
        in_roles_.push_back(voxels[i]);
    }
    const std::size_t moving = in_roles_.size();
    for (std::size_t m = 0; m < moving; ++m) {
        each_within(grid, 1, in_roles_[m], [&](std::uint32_t v, int) {
            const bool is_seen = grid[v].evidence.last_owner + 1 == grid.scans();
            if (!is_seen || said_[v].role != Role::none) return;
            said_[v].role = Role::touched;
            in_roles_.push_back(v);
        });
    }
    return {in_roles_.begin() + static_cast<std::ptrdiff_t>(moving), in_roles_.end()};
}

void InstantLabels::find_contacts(const Scan& scan, const PointVoxels& voxels,
                                  const EvidenceGrid& grid, const ScansConfig::Contact& config,
                                  Labels& labels) {
    const std::vector<std::uint32_t> touched = find_touched(voxels, labels, grid);
    // What moved elsewhere in the past is neither the surface nor on it now.
    const auto label = [&](std::uint32_t v) {
        if (said_[v].role == Role::moving) return Label::dynamic;
        return said_[v].label == Label::static_ ? Label::static_ : Label::unknown;
    };
    const Eigen::Isometry3f T_map_sensor = scan.T_world_sensor.cast<float>();
    label_above(
        contacts_of(touched, label, grid, config), voxels,
        [&](std::uint32_t v) { return said_[v].role == Role::touched; }, config,
        [&](std::size_t i) { return Point(T_map_sensor * scan.points[i]); }, labels);
}

void InstantLabels::keep(std::span<const std::uint32_t> kept) {
    std::vector<Said> said;
    said.reserve(kept.size());
    for (const std::uint32_t v : kept) said.push_back(said_[v]);
    said_ = std::move(said);
    for (Said& s : said_) s.role = Role::none;
    in_roles_.clear();
}

std::vector<VoxelOccupancy> static_among(std::span<const std::uint32_t> voxels,
                                         const EvidenceGrid& grid, const Config& config) {
    const auto occupancy = occupancy_of(grid, voxels, config.scans);
    std::vector<VoxelOccupancy> result;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (label_of(occupancy[i], config.map.occupancy_threshold) == Label::static_) {
            result.push_back({voxels[i], *occupancy[i]});
        }
    }
    return result;
}

namespace {

using LabelsOfVoxels = tsl::robin_map<std::uint32_t, Label>;

Label label_in(const LabelsOfVoxels& labels, std::uint32_t voxel) {
    const auto found = labels.find(voxel);
    return found == labels.end() ? Label::unknown : found->second;
}

/// The voxels of a scan that are not dynamic and touch one that is. Adds the labels of the voxels
/// around them, as far as the contact needs them, to those of the scan.
std::vector<std::uint32_t> touched_by_dynamic(std::span<const std::uint32_t> own,
                                              const EvidenceGrid& grid, const Config& config,
                                              LabelsOfVoxels& labels) {
    const auto label = [&](std::uint32_t v) { return label_in(labels, v); };
    std::vector<std::uint32_t> touched, around;
    for (const std::uint32_t voxel : own) {
        if (label(voxel) == Label::dynamic || !touches_dynamic(voxel, label, grid)) continue;
        touched.push_back(voxel);
        each_within(grid, 2, voxel, [&](std::uint32_t v, int) {
            if (!labels.contains(v)) around.push_back(v);
        });
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const VoxelOccupancy& v : static_among(around, grid, config)) {
        labels[v.voxel] = Label::static_;
    }
    return touched;
}

}  // namespace

void settle_points(const LocatedScan& scan, const EvidenceGrid& grid, const Config& config,
                   const ScansConfig::Contact& contact, Verdict& verdict) {
    PointVoxels own = scan.voxels;
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (!own.empty() && own.back() == kNoVoxel) own.pop_back();
    const auto occupancy = occupancy_of(grid, own, config.scans);
    LabelsOfVoxels labels;
    for (std::size_t i = 0; i < own.size(); ++i) {
        labels[own[i]] = label_of(occupancy[i], config.map.occupancy_threshold);
    }
    for (std::size_t i = 0; i < scan.voxels.size(); ++i) {
        if (scan.voxels[i] == kNoVoxel) continue;
        const auto at = std::lower_bound(own.begin(), own.end(), scan.voxels[i]) - own.begin();
        verdict.labels[i] = labels.at(scan.voxels[i]);
        verdict.probability[i] = occupancy[static_cast<std::size_t>(at)].value_or(0.0F);
    }
    const std::vector<std::uint32_t> touched = touched_by_dynamic(own, grid, config, labels);
    const auto label = [&](std::uint32_t v) { return label_in(labels, v); };
    label_above(
        contacts_of(touched, label, grid, contact), scan.voxels, [](std::uint32_t) { return true; },
        contact, [&](std::size_t i) { return scan.in_map.points[i]; }, verdict.labels);
}

VoxelDecisions decide_voxels(const EvidenceGrid& grid, const Config& config) {
    std::vector<std::uint32_t> all(grid.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto occupancy = occupancy_of(grid, all, config.scans);
    VoxelDecisions decided;
    decided.voxels.reserve(all.size());
    decided.probability.reserve(all.size());
    for (const std::optional<float>& probability : occupancy) {
        decided.voxels.push_back({label_of(probability, config.map.occupancy_threshold)});
        decided.probability.push_back(probability.value_or(0.0F));
    }
    const auto label = [&](std::size_t v) { return decided.voxels[v].label; };
    std::vector<std::uint8_t> touches(all.size());
    parallel_for(all.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            touches[v] = label(v) == Label::static_ && touches_dynamic(all[v], label, grid) ? 1 : 0;
        }
    });
    std::erase_if(all, [&](std::uint32_t v) { return touches[v] == 0; });
    decided.contacts = contacts_of(all, label, grid, config.scans.contact);
    for (const auto& [voxel, surface] : decided.contacts) decided.voxels[voxel].has_contact = true;
    return decided;
}

std::vector<std::optional<std::uint32_t>> occupied_since(const VoxelDecisions& decided,
                                                         const EvidenceGrid& grid,
                                                         const Config& config) {
    std::vector<std::optional<std::uint32_t>> since(grid.size());
    const auto longest = static_cast<std::uint32_t>(config.scans.evidence.longest_run);
    for (std::uint32_t v = 0; v < decided.voxels.size(); ++v) {
        if (decided.voxels[v].label != Label::dynamic) continue;
        const Evidence& e = grid[v].evidence;
        const bool is_seen = e.last == Sight::occupied && e.run >= longest && !e.seen_empty;
        // With fewer scans, the points may only lie near the voxel.
        const bool has_points = e.last_owner - e.since + 1 >= longest;
        if (is_seen && has_points) since[v] = e.since;
    }
    return since;
}

void decide_points(const LocatedScan& scan, const VoxelDecisions& decided, const EvidenceGrid& grid,
                   const Config& config, Verdict& verdict) {
    tsl::robin_set<std::uint32_t> moving;  // dynamic voxels with a point in this scan
    for (std::size_t i = 0; i < scan.voxels.size(); ++i) {
        const std::uint32_t voxel = scan.voxels[i];
        if (voxel >= decided.voxels.size()) continue;  // also for kNoVoxel
        verdict.labels[i] = decided.voxels[voxel].label;
        verdict.probability[i] = decided.probability[voxel];
        if (verdict.labels[i] == Label::dynamic) moving.insert(voxel);
    }
    for (const std::size_t i : points_above(scan, decided, verdict.labels, config.scans.contact)) {
        bool touches = false;
        each_within(grid, 2, scan.voxels[i],
                    [&](std::uint32_t v, int) { touches |= moving.contains(v); });
        if (touches) verdict.labels[i] = Label::dynamic;
    }
}

}  // namespace dynamic_filter
