#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every source has a test of its name in the mirrored folder: src/io/las.cpp has tests/io/las_test.cpp. The few others
are listed below with the test that covers them. An entry that is no longer needed is an error, too."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
APP = "apps/dynamicfilter"
COMMAND = "tests/apps/command_test.cpp"  # runs the command as a user does
OTHERS = {
    "src/io/bag_contents.cpp": "tests/io/bag_scans_test.cpp",
    "src/io/ros/pose_source.cpp": "tests/io/bag_scans_test.cpp",
    "src/io/las_header.cpp": "tests/io/las_test.cpp",
    "src/io/las_writer.cpp": "tests/io/las_test.cpp",
    **{f"src/sim/{unit}.cpp": "tests/sim/scene_city_test.cpp" for unit in ("city", "city_block", "city_library")},
    "src/sim/jam_people.cpp": "tests/sim/scene_jam_test.cpp",
    "src/sim/jam_traffic.cpp": "tests/sim/scene_jam_test.cpp",
    "src/sim/platform_people.cpp": "tests/sim/scene_platform_test.cpp",
    "src/sim/wagon.cpp": "tests/sim/scene_platform_test.cpp",
    f"{APP}/city/convert_map.cpp": COMMAND,
    f"{APP}/city/glb.cpp": "tests/apps/city/tileset_test.cpp",
    f"{APP}/edits/apply_edits.cpp": "tests/apps/edits_test.cpp",
    f"{APP}/edits/edit_lookup.cpp": "tests/apps/edits_test.cpp",
    f"{APP}/edits/edits.cpp": "tests/apps/edits_test.cpp",
    f"{APP}/edits/map_gaps.cpp": "tests/apps/edits_test.cpp",
    f"{APP}/edits/run_edits.cpp": "tests/apps/edits_test.cpp",
    **{f"{APP}/city/{unit}.cpp": "tests/apps/city/city_test.sh" for unit in (
        "city", "filter_tile", "filter_tiles", "merge", "plan_command", "run_city", "write_city")},
    f"{APP}/city/plan_file.cpp": "tests/apps/city/plan_test.cpp",
    f"{APP}/live/dds_configuration.cpp": "tests/apps/live/dds_peer_test.cpp",
    f"{APP}/live/dds_log.cpp": "tests/apps/live/dds_bus_test.cpp",
    f"{APP}/live/dds_type.cpp": "tests/apps/live/dds_bus_test.cpp",
    f"{APP}/live/foxglove_socket.cpp": "tests/apps/live/foxglove_server_test.cpp",
    **{f"{APP}/live/{unit}.cpp": "tests/apps/live/live_test.sh" for unit in (
        "dry_run", "live", "live_command")},
    f"{APP}/live/recorder.cpp": "tests/apps/live/session_test.cpp",
    f"{APP}/mpi/plugin.cpp": "tests/apps/mpi/mpi_workers_test.cpp",
    f"{APP}/view/edit_server.cpp": "tests/viewer/edit_checks.mjs",
    f"{APP}/view/live_view.cpp": "tests/viewer/live_checks.mjs",
    f"{APP}/view/shown.cpp": "tests/viewer/report_checks.mjs",
    f"{APP}/view/viewer_page.cpp": "tests/apps/view/page_test.cpp",
    **{f"{APP}/{unit}.cpp": COMMAND for unit in (
        "check", "compare", "convert", "demo", "evaluate", "frames", "info", "main", "motion", "render", "run", "run_reports",
        "run_sequence", "run_state", "serve", "simulate", "sinks", "draw/animation", "draw/canvas", "draw/cleaning",
        "draw/picture", "write_scans")},
}


def mirrored(source):
    folder, below = ("tests/apps", APP) if source.startswith(APP) else ("tests", "src")
    path = pathlib.PurePosixPath(source).relative_to(below)
    if path.parent.name == "" and below == "src":
        folder = "tests/core"
    return f"{folder}/{path.with_suffix('')}_test.cpp"


def main():
    faults = []
    sources = [p.relative_to(ROOT).as_posix() for top in ("src", APP) for p in sorted((ROOT / top).rglob("*.cpp"))]
    for source in sources:
        has_own = (ROOT / mirrored(source)).exists()
        if has_own and source in OTHERS:
            faults.append(f"{source} has {mirrored(source)}; take it from the list of others")
        if not has_own and source not in OTHERS:
            faults.append(f"{source} has no {mirrored(source)}")
    faults += [f"{source} is in the list of others, but does not exist" for source in OTHERS if source not in sources]
    faults += [f"{test}, which is to cover {source}, does not exist" for source, test in OTHERS.items()
               if not (ROOT / test).exists()]
    print("\n".join(faults) or f"{len(sources)} sources: {len(sources) - len(OTHERS)} with a test of their name, "
          f"{len(OTHERS)} with another one")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
