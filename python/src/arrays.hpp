// SPDX-License-Identifier: MIT
/// Conversion of numpy arrays. Input: one pass over the values, with any strides. Output: no copy;
/// an array keeps its data alive.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::python {

namespace py = pybind11;

/// From an array of float32 or float64, N x 3 or more columns. Raises TypeError and ValueError.
Points points_from(const py::object& given);
/// From a 4 x 4 matrix. Rotations within 1e-3 of orthogonal are made exact. Raises TypeError and
/// ValueError.
Pose pose_from(const py::object& given);
/// From an array of N float32 or float64, parallel to the points; empty for None. Times of points
/// that are not measured may have any value. Raises TypeError and ValueError.
std::vector<float> times_from(const py::object& given, const Points& points);

/// Moves a value to Python, so that arrays can refer to its data.
template <class T>
std::pair<T&, py::capsule> handed_over(T value) {
    auto kept = std::make_unique<T>(std::move(value));
    py::capsule owner(kept.get(), [](void* p) { delete static_cast<T*>(p); });
    return {*kept.release(), std::move(owner)};
}

py::array labels_array(Labels labels);                                     ///< N x uint8
py::array labels_array(const Labels& labels, py::handle owner);            ///< N x uint8
py::array points_array(const Points& points, py::handle owner);            ///< N x 3 float32
py::array pose_array(const Pose& pose, py::handle owner);                  ///< 4 x 4 float64
py::array poses_array(std::span<const Pose> poses);                        ///< M x 4 x 4 float64
py::array times_array(const std::vector<float>& times, py::handle owner);  ///< N float32
py::array fields_array(const io::Cloud& cloud, py::handle owner);          ///< N records

}  // namespace dynamic_filter::python
