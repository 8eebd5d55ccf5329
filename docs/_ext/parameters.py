#!/usr/bin/python3
"""Makes docs/parameters.md of what the command prints: parameters.py COMMAND > docs/parameters.md"""
import json
import subprocess
import sys

HEAD = """# Parameters

Made by `script/docs` from `dynamicfilter config --json`; a test fails if it is not up to date.

Change one with `--set map.voxel_size=0.1`, many with `--config FILE` (TOML, as `dynamicfilter config` prints it), and all of them to the paper's pipeline with
`--preset paper`. A run writes what was in force into its `config.toml`; the same file gives the same run again. What is out of bounds or unknown ends the command with
exit code 2: the message names the bounds, or the setting whose name is nearest.

```sh
dynamicfilter config > settings.toml
dynamicfilter config --preset paper --set submap.keyframes=10
```

Each method has its own settings, and `dynamicfilter config` prints those of the method in force. A setting of another method would have no effect, so it is an error that
names the method it belongs to. There are three methods: `scans` (preset `default`), `submaps` (preset `paper`) and `removert`, the paper's opponent.

With the default preset few settings matter to a user: `map.voxel_size` (finer costs time and memory, see [performance](performance.md)), `map.occupancy_threshold` (higher
removes more), `scans.max_keyframes` (memory), `keyframe.interval` and `keyframe.distance` (how often a scan observes). Three say only what comes out: `map.search_radius` (of
local maps), `map.keep_unknown` and `map.time` (what is in the static map: what never moved, or what was there when its place was last seen). All others of `scans.*` are the constants of the method. They are settings so that an ablation can change them (`script/ablate`) and a run
can tell what was in force; there is no need to tune them.

*Paper*: symbol, section or table there. The code: [`Config`](../include/dynamic_filter/settings.hpp).
"""

PARTS = {
    "method": "The method", "map": "The map", "odometry": "Poses that are found or refined", "keyframe": "Keyframes",
    "scans": "Method `scans`", "scans.observers": "Method `scans`: which keyframes are asked", "scans.sight": "Method `scans`: lines of sight",
    "scans.mirrors": "Method `scans`: mirrors",
    "scans.evidence": "Method `scans`: evidence of a voxel", "scans.vote": "Method `scans`: neighbours", "scans.instances": "Method `scans`: instances",
    "scans.contact": "Method `scans`: feet on the ground",
    "submap": "Method `submaps`: submaps", "front_end": "Method `submaps`: front-end", "back_end": "Method `submaps`: back-end",
}


def settings(command, preset):
    return json.loads(subprocess.run([command, "config", "--json", "--preset", preset], check=True, capture_output=True).stdout)


def shown(value):
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(value, (int, float)) else value


def section(key):
    return key.rpartition(".")[0] or key


def page(command):
    """Settings of all methods stand once, with the value of each preset in which they have an effect."""
    default, paper = ({s["key"]: s for s in settings(command, name)} for name in ("default", "paper"))
    text = HEAD
    for part, title in PARTS.items():
        text += f"\n## {title}\n\n| setting | default | paper | unit | bounds | meaning | paper's |\n|---|---|---|---|---|---|---|\n"
        for key, setting in {**default, **paper}.items():
            if section(key) != part:
                continue
            values = [shown(of[key]["value"]) if key in of else "" for of in (default, paper)]
            bounds = f"{shown(setting['min'])} .. {shown(setting['max'])}" if "min" in setting else ""
            unit = setting["unit"] if setting["unit"] != "1" else ""
            text += f"| `{key}` | {values[0]} | {values[1]} | {unit} | {bounds} | {setting['help']} | {setting['symbol']} |\n"
    known = {section(key) for key in {**default, **paper}}
    if known != set(PARTS):
        sys.exit(f"parameters.py: these parts have no title, or no settings: {known ^ set(PARTS)}")
    return text


if __name__ == "__main__":
    sys.stdout.write(page(sys.argv[1]))
