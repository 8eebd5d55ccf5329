// SPDX-License-Identifier: MIT
/// Decides what each point is: static, dynamic or unknown. The label of a point follows from the
/// occupancy of its voxel (vote.hpp); the final label also from where the point lies in it.
///
/// - instant labels: from the evidence up to the newest scan;
/// - settled labels: from the evidence so far, for any scan;
/// - final labels: from the whole recording.
#pragma once

#include <cstddef>
#include <cstdint>

#include <optional>
#include <span>
#include <vector>

#include <tsl/robin_map.h>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/settings.hpp"
#include "filter/archive.hpp"
#include "filter/contact.hpp"
#include "filter/evidence_grid.hpp"
#include "geometry/map_frame.hpp"

namespace dynamic_filter {

/// A voxel and its probability of being occupied.
struct VoxelOccupancy {
    std::uint32_t voxel = kNoVoxel;
    float probability = 0.0F;  ///< 0..1
};

/// Label of a voxel with this occupancy; an empty probability gives `unknown`.
inline Label label_of(std::optional<float> probability, double threshold) {
    if (!probability) return Label::unknown;
    return *probability >= static_cast<float>(threshold) ? Label::static_ : Label::dynamic;
}

/// Instant labels. Stores the latest label of each voxel. A voxel is judged again only when its own
/// score has changed enough; most voxels keep their label. Single caller.
class InstantLabels {
public:
    explicit InstantLabels(const Config& config)
        : config_(config.scans), threshold_(config.map.occupancy_threshold) {}

    /// The verdict on the scan that was last added to the grid; `voxels` are those of its points.
    Verdict label(std::size_t index, const PointVoxels& voxels, const EvidenceGrid& grid);

    /// Points of the scan that was last labelled become dynamic if they lie above the static
    /// surface of their voxel, and if the voxel touches one with dynamic points: feet and wheels.
    void find_contacts(const Scan& scan, const PointVoxels& voxels, const EvidenceGrid& grid,
                       const ScansConfig::Contact& config, Labels& labels);

    /// Renumbers the voxels: only those with the old numbers `kept` remain, in that order.
    void keep(std::span<const std::uint32_t> kept);

    /// Writes the labels, or reads them.
    void archive(Archive& archive) { archive.values(said_, offsetof(Said, role)); }

private:
    /// In the newest scan: the voxel holds dynamic points, or touches one that does.
    enum class Role : std::uint8_t { none, moving, touched };
    struct Said {
        // Score at the latest label; 2 is above all scores, so it means "never judged".
        float score = 2.0F;
        Label label = Label::unknown;
        std::uint8_t probability = 0;  // of being occupied, in 1/255
        Role role = Role::none;
    };
    std::vector<std::uint32_t> find_touched(const PointVoxels& voxels, const Labels& labels,
                                            const EvidenceGrid& grid);
    [[nodiscard]] bool is_due(const Said& said, const EvidenceGrid::State& state) const;

    ScansConfig config_;
    double threshold_;
    std::vector<Said> said_;               // by voxel
    std::vector<std::uint32_t> in_roles_;  // voxels with a role
};

/// Settled labels: writes them, and the probabilities, into `verdict`, which must be all unknown.
void settle_points(const LocatedScan& scan, const EvidenceGrid& grid, const Config& config,
                   const ScansConfig::Contact& contact, Verdict& verdict);

/// The static ones among the voxels, from the evidence so far.
std::vector<VoxelOccupancy> static_among(std::span<const std::uint32_t> voxels,
                                         const EvidenceGrid& grid, const Config& config);

/// The static surfaces in voxels.
using Contacts = tsl::robin_map<std::uint32_t, ContactSurface>;

/// The decisions on all voxels in the end. The labels are a table of their own because all points
/// of a recording are looked up in it, and it fits into the cache.
struct VoxelDecisions {
    struct OfVoxel {
        Label label = Label::unknown;
        bool has_contact = false;  ///< a static voxel that touches a dynamic one, with a surface
    };
    std::vector<OfVoxel> voxels{};
    std::vector<float> probability{};  ///< of being occupied, by voxel; 0: unknown
    Contacts contacts{};               ///< of the voxels that have one

    /// Of a voxel; empty: unknown.
    [[nodiscard]] std::optional<float> occupancy(std::uint32_t voxel) const {
        if (voxels[voxel].label == Label::unknown) return std::nullopt;
        return probability[voxel];
    }
};

/// Decides every voxel of the grid. Runs in parallel.
VoxelDecisions decide_voxels(const EvidenceGrid& grid, const Config& config);

/// For each dynamic voxel: the scan (in the order of the scans) from which on the voxel is occupied
/// until the end of the recording. It is empty unless that last run has as many keyframes as are
/// counted per run (see record()), and points in as many scans. Used for `map.time` = latest.
std::vector<std::optional<std::uint32_t>> occupied_since(const VoxelDecisions& decided,
                                                         const EvidenceGrid& grid,
                                                         const Config& config);

/// Final labels: writes them, and the probabilities, into `verdict`, which must be all unknown. A
/// point of a static voxel is dynamic if it lies above the static surface of the voxel, and if a
/// dynamic voxel nearby has points in the same scan. Thread-safe.
void decide_points(const LocatedScan& scan, const VoxelDecisions& decided, const EvidenceGrid& grid,
                   const Config& config, Verdict& verdict);

}  // namespace dynamic_filter
