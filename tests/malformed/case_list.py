# SPDX-License-Identifier: MIT
import pcd_cases
import ply_cases

CASES = pcd_cases.CASES + ply_cases.CASES
