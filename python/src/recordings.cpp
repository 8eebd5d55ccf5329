// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "frames.hpp"
#include "module.hpp"

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

io::Sequence open_recording(const fs::path& data, const py::kwargs& options) {
    const app::DataOptions how = data_options(data, const_cast<py::kwargs&>(options));
    refuse_unknown("open_recording", options);
    const py::gil_scoped_release others_go_on;
    io::Sequence sequence = app::open(how);
    if (!sequence.deskew) sequence.wants_times = true;
    return sequence;
}

io::Frame frame_at(const io::Sequence& sequence, py::ssize_t i) {
    const auto size = static_cast<py::ssize_t>(sequence.size());
    if (i < -size || i >= size) {
        throw py::index_error("scan " + std::to_string(i) + " of " + std::to_string(size));
    }
    const py::gil_scoped_release others_go_on;
    return io::read_frame(sequence, static_cast<std::size_t>(i < 0 ? i + size : i));
}

/// An array over data of a frame; it keeps the frame alive.
template <class View>
auto view(View of) {
    return [of](const py::object& self) -> py::object {
        return of(self.cast<const io::Frame&>(), self);
    };
}

void bind_frame(py::module_& module) {
    py::class_<io::Frame>(module, "Frame", R"(A scan of a recording.

Arrays are views of its memory, which they keep alive: writing to them changes the frame. Any thread
may read.)")
        .def_property_readonly("points", view([](const io::Frame& f, const py::object& self) {
                                   return points_array(f.points, self);
                               }),
                               "N x 3 float32: x y z [m] in the sensor's frame")
        .def_property_readonly("pose",
                               view([](const io::Frame& f, const py::object& self) -> py::object {
                                   if (!f.has_pose) return py::none();
                                   return pose_array(f.T_world_sensor, self);
                               }),
                               "4 x 4 float64: T_world_sensor [m]; None: nobody knows it")
        .def_readonly("stamp", &io::Frame::stamp, "[s]")
        .def_property_readonly(
            "times", view([](const io::Frame& f, const py::object& self) -> py::object {
                if (f.times.empty()) return py::none();
                return times_array(f.times, self);
            }),
            "N float32: when each point was measured [s], from the stamp on; None: the recording "
            "does not say, or the motion is undone (deskew)")
        .def_property_readonly(
            "truth", view([](const io::Frame& f, const py::object& self) -> py::object {
                if (f.truth.empty()) return py::none();
                return labels_array(f.truth, self);
            }),
            "ground truth, N uint8: 0 unknown, 9 static, 251 dynamic; None: there is none")
        .def_property_readonly("fields", view([](const io::Frame& f, const py::object& self) {
                                   return fields_array(f.cloud, self);
                               }),
                               "N records of all fields as in the file, units too: a structured "
                               "array");
}

}  // namespace

void bind_recordings(py::module_& module) {
    bind_frame(module);
    py::class_<io::Sequence>(module, "Recording",
                             R"(Scans, with poses if they are known: a sequence of Frame.

Scans are read when asked for and not kept. Any thread may read; the GIL is free meanwhile.)")
        .def("__len__", &io::Sequence::size, "How many scans there are.")
        // Access by index until IndexError; iteration works in the same way.
        .def("__getitem__", &frame_at, py::arg("i"),
             "Reads scan i; -1 is the last. Raises InputError if it cannot be used, IndexError if "
             "there is none.")
        .def_property_readonly(
            "format", [](const io::Sequence& s) { return io::to_string(s.format); },
            "kitti, benchmark, folder or bag")
        .def_property_readonly("has_truth", &io::Sequence::has_truth, "whether it is labelled")
        .def_readonly("notes", &io::Sequence::notes, "what was assumed, in sentences");
    module.def("read_cloud", &read_cloud, py::arg("file"),
               R"(Reads a cloud: .pcd, .ply, .las, .bin, .npy, .xyz, .txt or .csv.

Returns a structured array of N records with the file's fields, types, units and frame:
cloud["x"], cloud["intensity"]. Raises InputError.)");
    module.def("open_recording", &open_recording, py::arg("data"),
               R"(Opens a recording: a bag, or a folder with scans and poses.

data: its path. format: kitti, benchmark, folder or bag (otherwise recognised by looking at it).
poses: pose file, T_world_sensor [m] (otherwise the format's usual place), or "none": the recording's
own are left alone, and DynamicFilter finds them. topic, pose_topic: of a bag.
pose_fix: none, inverse, camera, lidar, wxyz, xyzw or mm, as `dynamicfilter check` advises.
points_in_world: scans are in the poses' frame. time_unit: s, ms, us or ns, of the stamps.
deskew: True undoes the sensor's motion during each scan, by the poses and the points' times. first, last, stride: which scans.
Returns a sequence of Frame: points N x 3 float32 [m] in the sensor's frame, pose 4 x 4
T_world_sensor [m] or None, stamp [s], times N float32 [s] or None, truth N uint8 or None, fields
N records. Raises InputError, ConfigError
and TypeError.)");
}

}  // namespace dynamic_filter::python
