#!/usr/bin/python3
"""Makes docs/parameters.md of what the command prints: parameters.py COMMAND > docs/parameters.md"""
import json
import subprocess
import sys

HEAD = """# Parameters

Made by `script/docs` from `dynamicfilter config --json`; a test fails if it is not up to date.

Change one with `--set back_end.voxel_size=0.1`, many with `--config FILE` (TOML, as `dynamicfilter config` prints it), and all of them to the paper's pipeline with
`--preset paper`. A run writes what was in force into its `config.toml`; the same file gives the same run again. What is out of bounds or unknown ends the command with
exit code 2: the message names the bounds, or the setting whose name is nearest.

```sh
dynamicfilter config > settings.toml
dynamicfilter config --preset paper --set submap.keyframes=10
```

With the default preset few of them matter: `back_end.voxel_size` (finer costs time and memory, see [performance](performance.md)), `back_end.occupancy_threshold` (higher removes
more), `back_end.max_scans` (memory), `submap.keyframe_interval` and `submap.keyframe_distance` (how often a scan observes). Two say only what comes out: `back_end.search_radius` (of local
maps) and `output.keep_unknown`. `submap.keyframes`, `front_end.*` and the rest of `back_end.*` belong to submaps that observe; `back_end.enabled=false` and `method=removert` make submaps of the
scans, too. What decides beyond these is not set but written in the code, with its reasons: [algorithm](algorithm.md).

Bold where the presets differ. *Paper*: symbol, section or table there. The code: [`Config`](../include/dynamic_filter/config.hpp).
"""

TITLES = {"": "The method", "submap": "Keyframes and submaps", "front_end": "Front-end", "back_end": "Back-end", "output": "Output"}


def settings(command, preset):
    return json.loads(subprocess.run([command, "config", "--json", "--preset", preset], check=True, capture_output=True).stdout)


def shown(value):
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(value, (int, float)) else value


def page(command):
    text, section = HEAD, None
    for setting, other in zip(settings(command, "default"), settings(command, "paper")):
        own, _, name = setting["key"].rpartition(".")
        if own != section:
            section = own
            text += f"\n## {TITLES[own]}\n\n| setting | default | paper | unit | bounds | meaning | paper's |\n|---|---|---|---|---|---|---|\n"
        value, paper = shown(setting["value"]), shown(other["value"])
        if value != paper:
            paper = f"**{paper}**"
        bounds = f"{shown(setting['min'])} .. {shown(setting['max'])}" if "min" in setting else ""
        unit = setting["unit"] if setting["unit"] != "1" else ""
        text += f"| `{setting['key']}` | {value} | {paper} | {unit} | {bounds} | {setting['help']} | {setting['symbol']} |\n"
    return text


if __name__ == "__main__":
    sys.stdout.write(page(sys.argv[1]))
