#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every source has a test of its name in the mirrored folder: src/draw/png.cpp has tests/draw/png_test.cpp. The few others
are listed below with the test that covers them. An entry that is no longer needed is an error, too."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COVERED = {  # test -> the units that it covers
    "arena/bench_test.py": "arena/bench arena/drive_arenas arena/find arena/map_arenas arena/moving_arenas arena/score_trial arena/submission arena/truth_cloud "
        "arena/twin_drives arena/twin_folders commands/bench",
    "arena/table_test.cpp": "arena/arenas arena/published",
    "commands/command_test.cpp": "commands/check commands/cleaning commands/compare commands/config commands/convert commands/convert_recording "
        "commands/demo commands/evaluate commands/info commands/main commands/odometry commands/options commands/picture commands/render commands/run "
        "commands/serve commands/shared_options commands/simulate draw/animation draw/canvas export/bag export/benchmark "
        "export/convert_map export/kitti export/nav2 export/objects export/octomap export/one_cloud export/outputs export/sink recording/scans "
        "recording/world_records run/drives_of_result run/run run/filter_whole run/run_state run/scored_scans run/summary run/write_scans",
    "export/crs_test.sh": "export/crs/plugin",
    "export/part_test.cpp": "export/places",
    "navigation/navigation_map_test.cpp": "navigation/floor navigation/surface_map",
    "export/tileset_test.cpp": "export/glb",
    "formats/clouds/cloud_test.cpp": "formats/clouds/bin",
    "formats/poses/poses_test.cpp": "base/utf16 formats/poses/pose_rows",
    "formats/clouds/las_test.cpp": "formats/clouds/las_header formats/clouds/las_writer",
    "check/place_drive_test.cpp": "check/local_places check/recognized_places",
    "live/dds_bus_test.cpp": "live/dds_log live/dds_qos live/dds_type",
    "live/dds_peer_test.cpp": "live/dds_configuration",
    "live/live_test.sh": "live/ask live/dry_run live/live live/map_saver live/requests commands/live",
    "live/session_test.cpp": "live/recorder",
    "online/online_filter_test.cpp": "online/scan_worker",
    "package/left_out_test.sh": "commands/live_left_out sim/caster_left_out",
    "page/page_test.cpp": "page/viewer_page",
    "recording/bag_scans_test.cpp": "recording/bag_contents recording/pose_source",
    "recording/layout_test.cpp": "recording/layouts/beside recording/layouts/kitti",
    "recording/benchmark_test.cpp": "recording/layouts/benchmark",
    "recording/layouts/nuscenes_test.cpp": "recording/layouts/nuscenes_tables",
    "recording/rig_test.cpp": "recording/rig_scans",
    "run/city_test.sh": "commands/merge commands/plan run/filter_tile run/filter_tiles run/job run/merge "
        "run/write_tiles",
    "run/edits_test.cpp": "run/apply_edits run/edit_lookup run/map_gaps run/run_edits",
    "run/mpi/mpi_workers_test.cpp": "run/mpi/plugin",
    "run/workers_test.cpp": "base/plugin",
    "run/plan_test.cpp": "run/plan_file",
    "sim/scene_city_test.cpp": "sim/city sim/city_block sim/city_library",
    "sim/scene_jam_test.cpp": "sim/jam_people sim/jam_traffic",
    "sim/scene_platform_test.cpp": "sim/platform_people sim/wagon",
    "upkeep/diff_test.sh": "commands/diff run/sources_of_result upkeep/diff",
    "upkeep/update_test.sh": "run/keep run/update",
    "viewer/edit_checks.mjs": "commands/edit_server",
    "viewer/live_checks.mjs": "page/live_view",
}
OTHERS = {f"src/{unit}.cpp": f"tests/{test}" for test, units in COVERED.items() for unit in units.split()}


def mirrored(source):
    path = pathlib.PurePosixPath(source).relative_to("src")
    return f"tests/{path.with_suffix('')}_test.cpp"


def main():
    faults = []
    sources = [p.relative_to(ROOT).as_posix() for p in sorted((ROOT / "src").rglob("*.cpp"))]
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
