# SPDX-License-Identifier: MIT
"""clean_folder.py RECORDING OUT: labels and the static map of a recording, as files."""
import sys

import dynamicfilter as df

result = df.run(sys.argv[1], sys.argv[2], overwrite=True)
static_map = df.read_cloud(result["output"] + "/static_map.pcd")
print(f'{result["metrics"]["scans"]} scans, {len(static_map)} points stay')
