// SPDX-License-Identifier: MIT
/// numpy's arrays in and out. In: one pass through whatever strides they have. Out: no copy; an
/// array keeps alive what it shows.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::python {

namespace py = pybind11;

/// From an array N x 3 or more columns, of float32 or float64. Raises TypeError and ValueError.
Points points_from(const py::object& given);
/// From a matrix 4 x 4. Rotations within 1e-3 of orthogonal are made exact. Raises TypeError and
/// ValueError.
Pose pose_from(const py::object& given);
/// From an array N of float32 or float64, parallel to the points; empty for None. Times of what is
/// not measured may be anything. Raises TypeError and ValueError.
std::vector<float> times_from(const py::object& given, const Points& points);

/// Hands a value over to Python, for arrays over what it holds.
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
