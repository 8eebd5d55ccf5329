"""What the default preset is made of, each as the settings that take it away."""
MECHANISMS = {
    "company's vote": ["scans.vote.company=0"],
    "neighbourhood's vote": ["scans.vote.neighborhood=0"],
    "switches: how often a voxel changed": ["scans.evidence.switch_power=0"],
    "returns: how often a voxel was hit": ["scans.evidence.return_power=0"],
    "margins grow with range": ["scans.sight.per_metre=0"],
    "new voxels ask earlier keyframes": ["scans.max_keyframes=1"],
    "contact": ["scans.contact.lowest=1"],  # nothing rises so far over its own surface
}
