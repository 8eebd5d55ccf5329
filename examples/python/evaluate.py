# SPDX-License-Identifier: MIT
"""evaluate.py RECORDING OUT: how good the labels in OUT are, where the recording has ground truth."""
import sys

import dynamicfilter as df

scores = df.evaluate(sys.argv[1], labels=sys.argv[2])
voxel = scores["voxel"]["excluded"]
print(f'PR {voxel["pr"]:.4f}  RR {voxel["rr"]:.4f}  F1 {voxel["f1"]:.4f}')
