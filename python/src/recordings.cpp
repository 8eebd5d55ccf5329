// SPDX-License-Identifier: MIT
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <span>
#include <string>
#include <tuple>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/writers.hpp"
#include "python/src/arrays.hpp"
#include "python/src/module.hpp"
#include "recording/layouts/registry.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::python {

namespace {

namespace fs = std::filesystem;

py::array read_cloud(const fs::path& file) {
    io::Cloud cloud;
    {
        const py::gil_scoped_release others_go_on;
        cloud = io::read_cloud(file);
    }
    const auto [kept, owner] = handed_over(std::move(cloud));
    return fields_array(kept, owner);
}

/// `fields`: (name, numpy's type without the byte order, values a point); `records`: packed, little
/// endian. What numpy has under other names is put into that form by the package's write_cloud().
std::string write_cloud(const fs::path& file, const py::list& fields, const py::bytes& records) {
    static const std::map<std::string, io::FieldType> kTypes{
        {"i1", io::FieldType::i8},  {"u1", io::FieldType::u8},  {"i2", io::FieldType::i16},
        {"u2", io::FieldType::u16}, {"i4", io::FieldType::i32}, {"u4", io::FieldType::u32},
        {"i8", io::FieldType::i64}, {"u8", io::FieldType::u64}, {"f4", io::FieldType::f32},
        {"f8", io::FieldType::f64}};
    io::Cloud cloud;
    for (const py::handle& field : fields) {
        const auto [name, type, count] =
            field.cast<std::tuple<std::string, std::string, std::uint32_t>>();
        io::add_field(cloud, name, kTypes.at(type), count);
    }
    const auto bytes = std::as_bytes(std::span(static_cast<std::string_view>(records)));
    cloud.data.assign(bytes.begin(), bytes.end());
    const py::gil_scoped_release others_go_on;
    return io::write_cloud(file, cloud).loss;
}

io::Recording open_recording(const fs::path& data, const py::kwargs& options) {
    const app::DataOptions how = data_options(data, const_cast<py::kwargs&>(options));
    refuse_unknown("open_recording", options);
    const py::gil_scoped_release others_go_on;
    const io::Recording recording = app::open(how);
    return recording.info().deskewed ? recording : io::with_times(recording);
}

io::FullScan frame_at(const io::Recording& recording, py::ssize_t i) {
    const auto size = static_cast<py::ssize_t>(recording.size());
    if (i < -size || i >= size) {
        throw py::index_error("scan " + std::to_string(i) + " of " + std::to_string(size));
    }
    const py::gil_scoped_release others_go_on;
    return recording.read(static_cast<std::size_t>(i < 0 ? i + size : i));
}

io::Recording part_of(const io::Recording& recording, const py::slice& chosen) {
    py::ssize_t start = 0, stop = 0, step = 0, count = 0;
    const auto size = static_cast<py::ssize_t>(recording.size());
    if (!chosen.compute(size, &start, &stop, &step, &count)) throw py::error_already_set();
    if (step < 0) throw py::value_error("a recording goes forwards; expected a step of 1 or more");
    if (count == 0) throw py::value_error("the slice has no scan");
    const auto first = static_cast<std::size_t>(start);
    return io::slice(recording, first, static_cast<std::size_t>(stop - 1),
                     static_cast<std::size_t>(step));
}

/// An array over data of a frame; it keeps the frame alive.
template <class View>
auto view(View of) {
    return [of](const py::object& self) -> py::object {
        return of(self.cast<const io::FullScan&>(), self);
    };
}

void bind_frame(py::module_& module) {
    py::class_<io::FullScan>(module, "Frame", R"(A scan of a recording.

Its arrays are views that keep its memory alive; writing to them changes the frame. Any thread may
read.)")
        .def_property_readonly("points", view([](const io::FullScan& f, const py::object& self) {
                                   return points_array(f.points, self);
                               }),
                               "N x 3 float32: x y z [m] in the sensor frame")
        .def_property_readonly(
            "pose", view([](const io::FullScan& f, const py::object& self) -> py::object {
                if (!f.has_pose) return py::none();
                return pose_array(f.T_world_sensor, self);
            }),
            "4 x 4 float64: T_world_sensor [m]; None: not known")
        .def_readonly("stamp", &io::FullScan::stamp, "[s]")
        .def_property_readonly(
            "times", view([](const io::FullScan& f, const py::object& self) -> py::object {
                if (f.times.empty()) return py::none();
                return times_array(f.times, self);
            }),
            "N float32: when each point was measured [s], from the stamp on; None: the recording "
            "does not say, or the motion is undone (deskew)")
        .def_property_readonly(
            "truth", view([](const io::FullScan& f, const py::object& self) -> py::object {
                if (f.truth.empty()) return py::none();
                return labels_array(f.truth, self);
            }),
            "ground truth, N uint8: 0 unknown, 9 static, 251 dynamic; None: there is none")
        .def_property_readonly(
            "sensor", [](const io::FullScan& f) { return f.sensor; },
            "Which of several sensors made the scan: its number in the rig file, from 0.")
        .def_property_readonly("fields", view([](const io::FullScan& f, const py::object& self) {
                                   return fields_array(f.cloud, self);
                               }),
                               "N records of all fields as in the file, units too: a structured "
                               "array");
}

std::string opening_text() {
    return fmt::format(R"(Opens a recording: a bag, or a folder with scans and poses.

data: path of the recording.
format: layout of the files; by default it is recognised. One of {}.
poses: pose file with T_world_sensor [m]; by default the usual place of the layout. With "none", the
poses of the recording are not read, and DynamicFilter estimates them.
topic, pose_topic: topics of the scans and of the poses of a bag.
pose_fix: none, inverse, camera, lidar, wxyz, xyzw, mm, cm, feet, transpose, mirror, ned or
relative, as `dynamicfilter check` advises.
points_in_world: True if points are in the frame of the poses.
sensor_at: "X,Y,Z" [m], place of the sensor in the frame of the points, if that is the vehicle's; points
and poses are then those of the sensor.
point_unit: unit of the coordinates of points: m, cm, mm or feet.
mask: file of boxes around what moves with the sensor, or its mesh (.stl), which is left out, or "none".
time_unit: unit of the stamps: s, ms, us or ns.
deskew: True does motion compensation of each scan with the poses and the times of the points.
first, last, stride: selection of scans.
Returns a recording of Frame: points N x 3 float32 [m] in the sensor frame, pose 4 x 4 T_world_sensor
[m] or None, stamp [s], times N float32 [s] or None, truth N uint8 or None, fields N records. Raises
InputError, ConfigError and TypeError.)",
                       fmt::join(io::layout_names(), ", "));
}

}  // namespace

void bind_recordings(py::module_& module) {
    bind_frame(module);
    py::class_<io::Recording>(module, "Recording",
                              R"(A recording of Frame: scans, with poses if they are known.

Scans are read on access and not kept. Any thread may read; the GIL is released during reading.)")
        .def("__len__", &io::Recording::size, "Number of scans.")
        // Access by index until IndexError; iteration works in the same way.
        .def("__getitem__", &frame_at, py::arg("i"),
             "Reads scan i; -1 is the last one. Raises InputError if the scan cannot be used, and "
             "IndexError if there is no such scan.")
        .def("__getitem__", &part_of, py::arg("scans"),
             "The recording of some of the scans, as recording[10:20:2]; nothing is read. Raises "
             "ValueError if that is none, or backwards.")
        .def_property_readonly(
            "format", [](const io::Recording& r) { return r.info().layout; },
            "name of the layout, such as kitti-360")
        .def_property_readonly(
            "has_truth", [](const io::Recording& r) { return r.info().has_truth(); },
            "True if there are ground-truth labels")
        .def_property_readonly(
            "notes", [](const io::Recording& r) { return r.info().notes; },
            "assumptions that were made, as sentences");
    module.def("read_cloud", &read_cloud, py::arg("file"),
               R"(Reads a cloud: .pcd, .ply, .las, .npy, .bin, .xyz, .txt or .csv.

Returns a structured array of N records with the fields, types, units and frame of the file:
cloud["x"], cloud["intensity"]. Raises InputError.)");
    module.def("write_cloud", &write_cloud);
    module.def("open_recording", &open_recording, py::arg("data"), opening_text().c_str());
}

}  // namespace dynamic_filter::python
