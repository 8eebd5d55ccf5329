#!/bin/sh
# `convert --crs` against PROJ's own programs.
#   crs_test.sh DYNAMICFILTER PYTHON
set -eu
command=$1
python=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
if ! command -v cs2cs > /dev/null || ! command -v projinfo > /dev/null; then
    echo "Skipped: proj-bin is not installed"
    exit 77
fi
fails() { # fails TEXT ARGUMENT...
    expected=$1
    shift
    ! "$command" convert "$@" > said 2>&1 || { echo "did not fail: $*"; exit 1; }
    grep -qF -- "$expected" said || { echo "said something else than '$expected':"; cat said; exit 1; }
}

"$command" simulate crowd -o rec --frames 5 -q
"$command" run rec -o out -q --no-report
origin=48.1374,11.5755,520
"$command" convert rec map.las --labels out --crs EPSG:32632 --origin $origin 2> /dev/null

# The sensor's first place is that of its pose, x m to the east and y m to the north of the origin.
read -r _ _ _ x _ _ _ y _ _ _ z < rec/poses.txt
echo "$x $y $z" | cct -d 4 +proj=pipeline +step +inv +proj=topocentric +ellps=WGS84 +lat_0=48.1374 +lon_0=11.5755 +h_0=520 \
    +step +inv +proj=cart +ellps=WGS84 +step +proj=utm +zone=32 +ellps=WGS84 > expected
"$python" - <<'PYTHON'
import csv, struct
place = [float(word) for word in open("expected").read().split()[:3]]
first = next(csv.DictReader(open("map_path.csv")))
for axis, value in zip("xyz", place):
    assert abs(float(first[axis]) - value) < 0.001, (first, place)
data = open("map.las", "rb").read()
header, = struct.unpack_from("<H", data, 94)
records, = struct.unpack_from("<I", data, 100)
encoding, = struct.unpack_from("<H", data, 6)
assert encoding & 16, "the bit of the WKT"
at = header
for _ in range(records):
    user, number, length = struct.unpack_from("<16sHH", data, at + 2)
    if user.rstrip(b"\0") == b"LASF_Projection" and number == 2112:
        open("map.wkt", "wb").write(data[at + 54:at + 54 + length].rstrip(b"\0"))
    at += 54 + length

# The first point of the first scan, in metres from the sensor: as far from it in the cloud, and in the same direction, but for
# the scale of the projection and the angle between its north and the true one, which is 1.9 degrees there.
x, y, z, _ = struct.unpack_from("<4f", open("rec/velodyne/000000.bin", "rb").read())
row = [float(word) for word in open("rec/poses.txt").readline().split()]
east, north, up = (row[4 * axis] * x + row[4 * axis + 1] * y + row[4 * axis + 2] * z for axis in range(3))
begin, = struct.unpack_from("<I", data, 96)
steps = struct.unpack_from("<3i", data, begin)
scales, offsets = struct.unpack_from("<3d", data, 131), struct.unpack_from("<3d", data, 155)
point = [step * scale + offset for step, scale, offset in zip(steps, scales, offsets)]
length = (east * east + north * north) ** 0.5
for got, expected in zip(point, (place[0] + east, place[1] + north, place[2] + up)):
    assert abs(got - expected) < 0.04 * length + 0.01, (point, place, east, north, up)
PYTHON

# Normals turn with the axes: the projection's north is 2.5755 deg * sin(48.1374 deg) = 1.918 degrees off the true one there.
for kind in world crs; do
    options=$([ $kind = world ] || echo "--crs EPSG:32632 --origin $origin")
    # shellcheck disable=SC2086  # words are meant
    "$command" convert rec normals_$kind.ply --labels out --normals --thin 0.5 $options 2> /dev/null
done
"$python" - <<'PYTHON'
import math, struct
def normals(name):
    data = open(name, "rb").read()
    head, body = data.split(b"end_header\n", 1)
    formats = {"float": "f", "double": "d", "uchar": "B", "ushort": "H", "int": "i", "uint": "I", "short": "h", "char": "b"}
    fields = [line.split()[1:] for line in head.decode().splitlines() if line.startswith("property")]
    layout = struct.Struct("<" + "".join(formats[kind] for kind, _ in fields))
    at = [[name for _, name in fields].index(axis) for axis in ("nx", "ny", "nz")]
    return [[row[k] for k in at] for row in layout.iter_unpack(body)]
turns = []
for before, after in zip(normals("normals_world.ply"), normals("normals_crs.ply"), strict=True):
    assert abs(before[2] - after[2]) < 0.001
    if math.hypot(*before[:2]) > 0.9:
        turns.append(math.remainder(math.atan2(after[1], after[0]) - math.atan2(before[1], before[0]), 2 * math.pi))
assert len(turns) > 50 and all(abs(abs(math.degrees(turn)) - 1.918) < 0.02 for turn in turns), turns[:5]
PYTHON
projinfo @map.wkt --identify | grep -qF "EPSG:32632: 100 %"

# What is in a coordinate system already, or shifted from it, and LAS files that are converted once more.
"$command" convert rec shifted.las --crs EPSG:32632 --origin 691000,5334000,500 2> /dev/null
"$command" info shifted.las | grep -q "x  *float64 *6909[0-9][0-9]"
"$command" convert shifted.las again.las --crs EPSG:32632 2> /dev/null
"$command" convert shifted.las part.las --box 690000,5333000,692000,5335000 2> /dev/null
for file in again.las part.las; do
    grep -qaF "WGS 84 / UTM zone 32N" $file || { echo "$file has no coordinate system"; exit 1; }
done

fails "not metres to the east" rec none.las --crs EPSG:2263 --origin 40.7,-73.9
fails "names a coordinate system already" map.las none.las --crs EPSG:32633
fails "names a coordinate system already" map.las none.las --crs EPSG:32632 --origin $origin
printf 'x,y,z\n1,2,3\nnan,1,1\n' > gap.csv
"$command" convert gap.csv gap.las --crs EPSG:32632 --origin $origin 2>&1 | grep -qF "1 points that are not finite"
fails "is not a projected coordinate system" rec none.las --crs EPSG:4326
fails "knows no such coordinate system" rec none.las --crs EPSG:1
fails "expected LAT,LON" rec none.las --crs EPSG:32632 --origin 1,2,3,4
fails "is meant for" rec none.las --crs EPSG:32632 --origin 48,80
fails "is meant for" rec none.las --crs EPSG:32632
fails "is for one cloud" rec none --crs EPSG:32632
fails "--origin is for" rec none.las --origin $origin
[ ! -e none.las ] && [ ! -e none_path.csv ] && [ ! -e none ]
