// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "python/src/arrays.hpp"
#include "python/src/kept_filter.hpp"
#include "python/src/module.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::python {

namespace {

std::size_t number_kept(const py::object& keep) {
    if (py::isinstance<py::bool_>(keep)) return keep.cast<bool>() ? SIZE_MAX : 0;
    if (!PyIndex_Check(keep.ptr())) throw py::type_error("keep: expected True, False or a number");
    const auto number = keep.cast<py::ssize_t>();
    if (number < 0) throw py::value_error("keep: expected 0 or more scans");
    return static_cast<std::size_t>(number);
}

std::unique_ptr<KeptFilter> make_filter(const py::object& config, int threads,
                                        const py::object& keep, double horizon,
                                        std::size_t max_bytes) {
    const OnlineOptions options{
        .overload = Overload::wait, .horizon = horizon, .max_bytes = max_bytes, .threads = threads};
    for (const std::string& fault : violations(options)) throw py::value_error(fault);
    return std::make_unique<KeptFilter>(app::load_config(config_options(config)), options,
                                        number_kept(keep));
}

std::optional<double> stamp_from(const py::object& given) {
    if (given.is_none()) return std::nullopt;
    const auto stamp = taken<double>(given, "stamp", "seconds as a number");
    if (std::isfinite(stamp)) return stamp;
    throw py::value_error(fmt::format("stamp: expected seconds as a finite number, got {}", stamp));
}

py::array push(KeptFilter& filter, const py::object& points, const py::object& pose,
               const py::object& stamp, const py::object& times, std::uint8_t sensor) {
    Pushed pushed;
    pushed.sensor = sensor;
    pushed.stamp = stamp_from(stamp);
    if (!pose.is_none()) pushed.T_world_sensor = pose_from(pose);
    pushed.points = points_from(points);
    pushed.times = times_from(times, pushed.points);
    Labels labels;
    {
        const py::gil_scoped_release others_go_on;
        labels = filter.push(std::move(pushed));
    }
    return labels_array(std::move(labels));
}

py::list corrections(KeptFilter& filter, const py::object& asked) {
    const auto newest =
        taken<std::optional<std::size_t>>(asked, "newest", "a number of scans, 0 or more");
    std::vector<KeptFilter::Correction> found;
    {
        const py::gil_scoped_release others_go_on;
        found = filter.corrections(newest.value_or(SIZE_MAX));
    }
    py::list list;
    for (auto& [scan, labels] : found) {
        list.append(py::make_tuple(scan, labels_array(std::move(labels))));
    }
    return list;
}

/// Negative numbers count back from the newest scan.
std::size_t scan_number(KeptFilter& filter, const py::object& asked) {
    auto scan = taken<py::ssize_t>(asked, "scan", "the number of a scan");
    if (scan < 0) scan += static_cast<py::ssize_t>(filter.size());
    if (scan < 0) throw py::index_error("scan: there are fewer scans");
    return static_cast<std::size_t>(scan);
}

py::array labels(KeptFilter& filter, const py::object& asked) {
    const std::size_t scan = scan_number(filter, asked);
    Labels found;
    {
        const py::gil_scoped_release others_go_on;
        found = filter.labels(scan);
    }
    return labels_array(std::move(found));
}

Located located(KeptFilter& filter, const py::object& asked) {
    const std::size_t scan = scan_number(filter, asked);
    const py::gil_scoped_release others_go_on;
    return filter.located(scan);
}

py::array pose(KeptFilter& filter, const py::object& asked) {
    const Located found = located(filter, asked);
    return poses_array({&found.T_world_sensor, 1}).reshape({4, 4});
}

const char* status(KeptFilter& filter, const py::object& asked) {
    const Located found = located(filter, asked);
    if (!found.status) return "given";
    static constexpr const char* kNames[] = {"good", "weak", "lost"};
    return kNames[static_cast<std::size_t>(*found.status)];
}

py::array poses(KeptFilter& filter) {
    std::vector<std::optional<Located>> found;
    {
        const py::gil_scoped_release others_go_on;
        found = filter.all_located();
    }
    Pose unknown;
    unknown.matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
    std::vector<Pose> T_world_sensor;
    for (const auto& scan : found) T_world_sensor.push_back(scan ? scan->T_world_sensor : unknown);
    return poses_array(T_world_sensor);
}

/// Two arrays over the same voxels.
py::tuple map_arrays(std::vector<StaticVoxel> map) {
    const auto [voxels, owner] = handed_over(std::move(map));
    const auto n = static_cast<py::ssize_t>(voxels.size());
    constexpr py::ssize_t kStep = sizeof(StaticVoxel), kSize = sizeof(double);
    const StaticVoxel* const first = voxels.data();
    return py::make_tuple(py::array(py::dtype::of<double>(), {n, py::ssize_t{3}}, {kStep, kSize},
                                    n > 0 ? first->center.data() : nullptr, owner),
                          py::array(py::dtype::of<float>(), {n}, {kStep},
                                    n > 0 ? &first->probability : nullptr, owner));
}

py::tuple static_map(KeptFilter& filter) {
    std::vector<StaticVoxel> map;
    {
        const py::gil_scoped_release others_go_on;
        map = filter.static_map();
    }
    return map_arrays(std::move(map));
}

py::tuple local_map(KeptFilter& filter, const py::object& pose, const py::object& reach) {
    const auto radius = taken<std::optional<double>>(reach, "radius", "metres, or None");
    if (radius && !(*radius >= 0.0)) throw py::value_error("radius: expected metres, 0 or more");
    std::optional<Pose> T_world_query;
    if (!pose.is_none()) T_world_query = pose_from(pose);
    std::vector<StaticVoxel> map;
    {
        const py::gil_scoped_release others_go_on;
        map = filter.local_map(T_world_query, radius);
    }
    return map_arrays(std::move(map));
}

}  // namespace

void bind_filter(py::module_& module) {
    using Release = py::call_guard<py::gil_scoped_release>;
    py::class_<KeptFilter>(module, "DynamicFilter", R"(Takes scans and returns their labels.

config: None, a preset ("default", "paper"), the path of a TOML file, or a dict of settings such as
{"map.voxel_size": 0.1} or {"preset": "paper", "submap": {"keyframes": 10}}; `dynamicfilter config`
prints their units and bounds.
threads: number of threads of each stage; 0: all cores.
keep: True keeps every scan for labels(), corrections(), pose() and status(), at 13 bytes per point
(14 with the preset "paper"). A number keeps this many of the newest scans. False keeps only the
newest pose.
horizon: [m] the map farther away is removed; at a break of the trajectory, the whole map is
removed. 0: nothing is removed.
max_bytes: limit on the memory of the map; 0: no limit. A voxel takes about 172 bytes.

One filter serves one sensor. Scans are numbered from 0 in their order; refused scans get no number.
Input arrays are copied; returned arrays belong to the caller. Any thread may call; the GIL is
released during calls. Raises ConfigError, TypeError and ValueError.)")
        .def(py::init(&make_filter), py::arg("config") = py::none(), py::kw_only(),
             py::arg("threads") = 0, py::arg("keep") = true, py::arg("horizon") = 0.0,
             py::arg("max_bytes") = 0)
        .def("push", &push, py::arg("points"), py::arg("pose") = py::none(),
             py::arg("stamp") = py::none(), py::arg("times") = py::none(), py::arg("sensor") = 0,
             R"(Takes a scan; returns its instant verdict.

points: N x 3 or more columns, float32 or float64, with any strides: x y z [m] in the sensor frame;
further columns are ignored. Points that are not finite, or at the origin, are no measurement.
Integers, a foreign byte order and structured arrays raise TypeError.
pose: 4 x 4, T_world_sensor, which maps sensor coordinates into the world [m]. A rotation that is
off by up to 0.001 is made exact; a larger error raises ValueError. None: the filter estimates the
pose, and pose() returns it; the world is then the sensor frame of the first scan. Either all scans
have a pose, or none. With the setting odometry.refine, given poses are refined.
stamp: [s], increasing. A scan that is up to 1 s older than the newest one is late. A scan that is
even older begins a new map, and notices() reports it. None: scan number i gets the stamp i / 10 [s].
If the filter estimates poses and the rate is not ten scans per second, give stamps. Either all scans
have a stamp, or none.
times: N float32 or float64, the time of each point [s] relative to the stamp. If the filter
estimates or refines the pose, it uses them for motion compensation; otherwise they have no effect.
None: all points were measured at once, or motion compensation was already done.
sensor: 0 to 255, which of several sensors on one vehicle made the scan (Frame.sensor); each scan then
needs the pose of its own sensor.
Returns labels: N uint8: 0 unknown, 9 static, 251 dynamic. With the preset "paper" all are 0;
corrections() returns the labels when a window of scans is full.
Raises TypeError, ValueError, and Error after finish(), or if the scan is late or a duplicate, or if
only some of the scans have a pose or a stamp (the scan is then not taken, and the filter goes on).
Raises as flush() does.)")
        .def(
            "corrections", &corrections, py::arg("newest") = py::none(),
            R"(Returns the kept scans whose labels have changed since push(), labels() or this call returned them.

newest: checks only this number of newest scans; each takes about as long as labels().
Returns a list of (number of the scan, labels: N uint8, as push() returns them). Raises as flush()
does.)")
        .def("labels", &labels, py::arg("scan"),
             R"(The labels of a scan from all evidence so far; after finish(), the final ones.

scan: its number; negative ones count from the newest. Returns N uint8: 0 unknown, 9 static, 251 dynamic.
Raises IndexError if the scan is not kept. Raises as flush() does.)")
        .def("pose", &pose, py::arg("scan"),
             R"(The pose of a scan: the estimated or refined one, or otherwise the given one.

scan: its number; negative ones count from the newest. Returns T_world_sensor [m]: 4 x 4 float64.
Raises TypeError, IndexError if the scan is not kept, and Error if its pose is not estimated yet: with
the preset "paper" it is known when a window of scans is full, or after finish().)")
        .def("poses", &poses,
             R"(The poses of all kept scans, oldest first, as pose() returns them.

Returns M x 4 x 4 float64; NaN where a pose is not estimated yet. Raises nothing.)")
        .def("status", &status, py::arg("scan"),
             R"(How reliable the pose of a scan is.

scan: its number; negative ones count from the newest. Returns "given" if the user
gave the pose; otherwise "good", "weak" (the scan leaves one direction undetermined, in which the
previous motion is extrapolated) or "lost" (too few points lie on the map, so the previous motion is
extrapolated). Raises as pose() does.)")
        .def("static_map", &static_map, R"(The static voxels of the whole map.

After finish(): the merged map. Before finish(): the map since the last break of the trajectory (with
the preset "paper": the same as local_map()).
Returns (centers: M x 3 float64 [m] in the world frame, probability: M float32, the probability 0..1
that the voxel is occupied). Raises as flush() does.)")
        .def("local_map", &local_map, py::arg("pose") = py::none(), py::arg("radius") = py::none(),
             R"(The static voxels around a place, from all evidence so far.

pose: 4 x 4, T_world_query, at any place; None: the pose of the last scan.
radius: [m]; None: `map.search_radius`. With the preset "paper", it is always `map.search_radius`.
Returns (centers, probability), as static_map() does. Raises TypeError and ValueError, and as flush()
does.)")
        .def("flush", &KeptFilter::flush, Release(),
             "Waits until every pushed scan is in the map. Raises the error of the filter's "
             "threads, "
             "if there was one (MemoryError); the filter cannot be used any more then.")
        .def("finish", &KeptFilter::finish, Release(),
             "Decides every voxel. After it, labels() are final, and push() raises Error. "
             "Raises as flush() does.")
        .def(
            "notices", &KeptFilter::notices, Release(),
            "Returns the events since the last call (such as a break of the trajectory, at which a "
            "new map begins): a list of (number of the scan, sentence). Raises nothing.")
        .def("__len__", &KeptFilter::size, Release(), "How many scans were taken.");
}

}  // namespace dynamic_filter::python
