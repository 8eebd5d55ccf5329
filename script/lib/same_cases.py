"""What script/same runs: recordings, presets and ways of running; and the hashes of what a run leaves."""
import hashlib
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

TIMEOUT = 1200  # seconds for one call of the command


@dataclass(frozen=True)
class Recording:
    tile_voxels: int       # makes several tiles
    simulate: tuple = ()   # how the command makes it; the others are real
    scans: int = 0         # the first scans of a real one


RECORDINGS = {
    "crowd": Recording(20000, ("crowd", "--frames", 40)),
    "street": Recording(50000, ("street", "--sensor", "hdl64", "--frames", 18)),
    "city": Recording(70000, ("city", "--km", 0.1, "--drives", 2, "--frames", 40)),
    # Scans to be refined and deskewed, of PCD files.
    "swept": Recording(20000, ("crowd", "--sweep", "--pose-noise", 0.03, "--pose-noise-deg", 0.2, "--frames", 30, "--seed", 2)),
    "kitti_ins": Recording(60000, scans=30),      # 64 beams, poses of GPS that need refining
    "dense_128": Recording(60000, scans=20),      # 128 beams, no poses
    "nuscenes_0006": Recording(60000, scans=40),  # 32 beams, 2 Hz
}
PRESETS = {"default": ("--preset", "default"), "paper": ("--preset", "paper"),
           "removert": ("--preset", "paper", "--set", "method=removert"),
           "-": ()}  # of what has no preset
OUTPUTS = {"las": "all.las", "ply": "all.ply", "npy": "all.npy", "mcap": "all.mcap", "bag": "all.bag", "db3": "all.db3",
           "kitti": "kitti", "benchmark": "benchmark"}


class Refused(Exception):
    """The command does not do this, or not with this recording."""


class Failed(Exception):
    """Nothing that could be kept."""


def link_scans(source, target, first, end):
    """A recording of some scans of another one. Every folder has a file for each scan, every text file a line."""
    target.mkdir(parents=True)
    for path in sorted(source.iterdir()):
        if path.is_dir():
            (target / path.name).mkdir()
            for file in sorted(path.iterdir())[first:end]:
                (target / path.name / file.name).symlink_to(file.resolve())
        else:
            lines = path.read_text().splitlines(keepends=True)
            (target / path.name).write_text("".join(lines[first:end]))


def make(name, command, data, folder):
    """Makes folder/all, a recording or one for each drive, and folder/halves of the first drive."""
    recording, whole = RECORDINGS[name], folder / "all"
    folder.mkdir(parents=True)
    if recording.simulate:
        words = [command, "simulate", *recording.simulate, "-o", whole, "-q"]
        done = subprocess.run([str(w) for w in words], capture_output=True, text=True, errors="replace")
        if done.returncode != 0:
            raise Failed(f"{name} cannot be simulated: {done.stderr.strip()}")
    else:
        source = data / name
        if not source.is_dir():
            source = folder / "unpacked" / name
            source.parent.mkdir()
            subprocess.run(["tar", "-C", source.parent, "-xf", data / f"{name}.tar.xz"], check=True)
        link_scans(source, whole, 0, recording.scans)
    if name != "city":
        count = max(len(list(path.iterdir())) for path in whole.iterdir() if path.is_dir())
        link_scans(whole, folder / "halves/half_1", 0, count // 2)
        link_scans(whole, folder / "halves/half_2", count // 2, count)


def available(name, data):
    return bool(RECORDINGS[name].simulate) or bool(data) and ((data / name).is_dir() or (data / f"{name}.tar.xz").is_file())


def digest(parts):
    """Of names and bytes."""
    total = hashlib.sha256()
    for name, content in parts:
        total.update(f"{name} {len(content)}\n".encode() + content)
    return total.hexdigest()[:16]


def files_below(folder):
    return [p.relative_to(folder) for p in sorted(folder.rglob("*")) if p.is_file()]


def file_digest(path):
    """Of a file, or of all files in a folder."""
    if path.is_dir():
        return digest((f, (path / f).read_bytes()) for f in files_below(path))
    return digest([("", path.read_bytes())])


def names_of(value):
    """The names in a JSON text without the numbers."""
    return re.sub(rb"-?\d[\d.eE+-]*", b"0", value)


def kind_of(path):
    if path.suffix == ".label":
        return "labels"
    if path.name.startswith("static_map") or "map" in path.parts[:-1]:
        return "map"
    if path.name.startswith("dynamic_points"):
        return "dynamic"
    return {"metrics.json": "metrics", "poses.txt": "poses", "run.log": "log", "timing.json": "timing",
            "config.toml": "config", "recording.json": "recording"}.get(path.name, "others")


class Work:
    """A case at work, in a folder of its own: calls of the command and what they said."""

    def __init__(self, command, preset, recording, folder, scratch):
        self.command, self.preset, self.folder, self.scratch = command, PRESETS[preset], folder, scratch
        self.tile_voxels = RECORDINGS[recording].tile_voxels
        made = scratch / "recordings" / recording
        # As seen from the case's folder, so that messages do not depend on the place of the scratch folder.
        seen = Path("../../recordings") / recording
        self.all = [seen / "all" / d.name for d in sorted((made / "all").glob("drive_*"))] or [seen / "all"]
        self.single = self.all[0]
        self.several = self.all if len(self.all) > 1 else [seen / "halves/half_1", seen / "halves/half_2"]
        self.said = []

    def plain(self, text):
        """Without speeds, progress and the place of the scratch folder."""
        text = re.sub(r"^(speed |\w+ +\d+/\d+ \[).*\n?", "", text, flags=re.M)
        return text.replace(str(self.scratch), "SCRATCH")

    def call(self, *words):
        words = [str(w) for w in words]
        done = subprocess.run([str(self.command), *words], cwd=self.folder, capture_output=True, text=True, errors="replace",
                              timeout=TIMEOUT)
        text = self.plain(done.stderr) + self.plain(done.stdout) + f"exit {done.returncode}\n"
        if done.returncode in (2, 3):
            raise Refused(text)
        if done.returncode not in (0, 4):
            raise Failed(f"{' '.join(words)}: {text.strip()}")
        self.said.append(text)
        return done.stdout

    def run(self, drives, *options, out="out"):
        self.call("run", *drives, "-o", out, "--no-report", "--threads", 2, *self.preset, *options)

    def log(self):
        return {"log": digest([("said", "".join(self.said).encode())])}

    def left(self):
        """What is in the folder out, and what the command said."""
        out, groups = self.folder / "out", {}
        for file in files_below(out):
            content, kind = (out / file).read_bytes(), kind_of(file)
            if kind == "timing":
                content = names_of(content)
            elif file.name in ("run.log", ".run"):
                content = re.sub(r"^version .*\n", "", self.plain(content.decode()), flags=re.M).encode()
            groups.setdefault(kind, []).append((file, content))
        groups.setdefault("log", []).append(("said", "".join(self.said).encode()))
        return {kind: digest(parts) for kind, parts in groups.items()}

    def ran(self, drives, *options):
        self.run(drives, *options)
        return self.left()

    def tiled(self):
        self.run(self.all, "--memory", "2G", "--tile-voxels", self.tile_voxels)
        self.expect_tiles()

    def expect_tiles(self):
        if len(list((self.folder / "out/map").glob("*.pcd"))) < 2:
            raise Failed("this is to have several tiles, so its tile_voxels must be smaller")

    def tiles(self):
        self.tiled()
        return self.left()

    def parts(self, count, planned=False):
        tiles = ("--tile-voxels", self.tile_voxels)
        if planned:
            self.call("plan", *self.all, "-o", "planned", *self.preset, *tiles)
        names = [f"part_{i}" for i in range(1, count + 1)]
        for i, name in enumerate(names, 1):
            self.run(self.all, "--part", f"{i}/{count}", *tiles, *(("--plan", "planned") if planned else ()), out=name)
        self.call("merge", *names, "-o", "out", "--threads", 2)
        self.expect_tiles()
        return self.left()

    def plan(self):
        said = self.call("plan", *self.all, "--tile-voxels", self.tile_voxels, "--parts", 5, "--json", *self.preset)
        return {"text": digest([("plan", said.encode())]), **self.log()}

    def check(self):
        self.call("check", *self.all)
        return self.log()

    def info(self):
        self.call("info", self.single)
        return self.log()

    def eval(self):
        self.run([self.single])
        for words in (("--labels", "out"), ("--map", "out/static_map.pcd"), ("--labels", "out", "--min-range", 3, "--max-range", 30)):
            self.call("eval", "--truth", self.single, *words, "--json", f"scores_{len(self.said)}.json")
        return {"scores": digest((p.name, p.read_bytes()) for p in sorted(self.folder.glob("scores_*.json"))), **self.log()}

    def converted(self, outputs, source, *options):
        """A hash for each output that the command writes, and those which it refuses together."""
        hashes, refused = {}, []
        for kind, (name, layout) in outputs.items():
            try:
                self.call("convert", source, name, *(("--to", layout) if layout else ()), *options)
                hashes[kind] = file_digest(self.folder / name)
            except Refused as error:
                refused.append((kind, str(error).encode()))
            path = self.folder / name
            shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
        return {**hashes, **({"refused": digest(refused)} if refused else {})}

    def convert(self):
        self.run([self.single])
        outputs = {kind: (name, kind if name == kind else None) for kind, name in OUTPUTS.items()}
        found = ("--poses", "out/poses.txt") if (self.folder / "out/poses.txt").exists() else ()
        hashes = self.converted(outputs, self.single, "--labels", "out", *found)
        hashes |= self.converted({"autoware": ("autoware", "autoware")}, "out/static_map.pcd")
        return {**hashes, **self.log()}

    def convert_map(self):
        self.tiled()
        hashes = self.converted({layout: (layout, layout) for layout in ("3dtiles", "las", "autoware")}, "out")
        self.call("info", "out")
        return {**hashes, **self.log()}

    def recording(self):
        folder = self.scratch / "recordings" / self.single.parts[3] / "all"
        return {"files": file_digest(folder)}


RUNS = {
    "whole": lambda work: work.ran([work.single]),
    "online": lambda work: work.ran([work.single], "--online", "--speed", 0),
    "odometry": lambda work: work.ran([work.single], "--poses", "none"),
    "stride": lambda work: work.ran([work.single], "--first", 3, "--last", 30, "--stride", 2),
    "several": lambda work: work.ran(work.several),
    "latest": lambda work: work.ran(work.several, "--set", "map.time=latest"),
    "tiles": Work.tiles,
    "parts-1": lambda work: work.parts(1),
    "parts-2": lambda work: work.parts(2, planned=True),
    "parts-5": lambda work: work.parts(5),
    "plan": Work.plan,
}
AFTER = {"convert": Work.convert, "convert-map": Work.convert_map, "eval": Work.eval}  # of a run with the default preset
WITHOUT = {"recording": Work.recording, "check": Work.check, "info": Work.info}        # no preset
ONLY = {"latest": ("city",), "eval": ("crowd", "nuscenes_0006")}  # where things come and stay; with ground truth
WAYS = {**RUNS, **AFTER, **WITHOUT}


def all_cases():
    """Recording, preset and way of each."""
    for recording in RECORDINGS:
        cases = [("-", way) for way in WITHOUT] + [(preset, way) for preset in ("default", "paper") for way in RUNS]
        cases += [("removert", "whole")] + [("default", way) for way in AFTER]
        yield from ((recording, preset, way) for preset, way in cases if recording in ONLY.get(way, RECORDINGS))


def hashes_of(case, command, scratch):
    """The hashes of what a case leaves, by kind."""
    recording, preset, way = case
    folder = scratch / "cases" / "_".join(case)
    folder.mkdir(parents=True)
    try:
        return WAYS[way](Work(command, preset, recording, folder, scratch))
    except Refused as error:
        return {"refused": digest([("said", str(error).encode())])}
    except subprocess.TimeoutExpired as error:
        raise Failed(f"a call takes more than {error.timeout} s") from error
    finally:
        shutil.rmtree(folder)
