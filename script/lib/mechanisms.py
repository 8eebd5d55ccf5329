"""What the default preset is made of, each as the settings that take it away."""
MECHANISMS = {
    "company's vote": ["scans.vote.company=0"],
    "neighbourhood's vote": ["scans.vote.neighborhood=0"],
    "switches: how often a voxel changed": ["scans.evidence.switch_power=0"],
    "returns: how often a voxel was hit": ["scans.evidence.occupied_power=0", "scans.evidence.hit_power=0"],
    "weak sights count less": ["scans.sight.clear=0", "scans.sight.clear_voxels=0", "scans.sight.clear_unseen=0"],
    "long runs count as short ones": ["scans.evidence.longest_run=255"],
    "the same traffic for longer tells no more": ["scans.evidence.enough=1e6"],
    "the surely static are not outvoted": ["scans.evidence.static_limit=1"],
    "thin things judged by beams through them": ["scans.evidence.thin_benefit=10"],
    # No track ever moves or comes: that would take more voxels than there are.
    "instances": [
        "scans.instances.gone=1000",
        "scans.instances.arrived_scans=1000",
        "scans.instances.displaced=1000",
    ],
    "surfaces that moved steadily": ["scans.instances.displaced=1000"],
    "objects that came": ["scans.instances.arrived_scans=1000"],
    "neighbours weighted by looks": ["scans.vote.sure=0"],
    "poses aligned where scans disagree": ["scans.sight.alignment_gain=1"],
    "margins grow with range": ["scans.sight.per_metre=0"],
    "new voxels ask earlier keyframes": ["scans.max_keyframes=1"],
    "mirrors": ["scans.mirrors.matched=1"],
    "contact": ["scans.contact.lowest=1"],  # nothing rises so far over its own surface
}
