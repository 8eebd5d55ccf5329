// SPDX-License-Identifier: MIT
#include "python/src/arrays.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace dynamic_filter::python {

namespace {

std::string text(const py::handle& value) { return py::str(value); }

std::string shape_of(const py::array& array) { return text(array.attr("shape")); }

/// The values are copied, because they may be unaligned.
template <class T>
float number_at(const char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<float>(value);
}

template <class T>
Points read_points(const py::array& array) {
    const auto* const bytes = static_cast<const char*>(array.data());
    const py::ssize_t row = array.strides(0), column = array.strides(1);
    Points points(static_cast<std::size_t>(array.shape(0)));
    const py::gil_scoped_release others_go_on;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const char* const at = bytes + static_cast<py::ssize_t>(i) * row;
        for (int c = 0; c < 3; ++c) points[i][c] = number_at<T>(at + c * column);
    }
    return points;
}

template <class T>
std::vector<float> read_times(const py::array& array) {
    const auto* const bytes = static_cast<const char*>(array.data());
    std::vector<float> times(static_cast<std::size_t>(array.shape(0)));
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] = number_at<T>(bytes + static_cast<py::ssize_t>(i) * array.strides(0));
    }
    return times;
}

bool is_single(const py::array& array) { return py::isinstance<py::array_t<float>>(array); }

/// A masked array's data with NaN in place of what is masked, as numpy would hide the mask from us.
py::object without_mask(const py::object& given) {
    const py::object masked = py::module_::import("numpy.ma").attr("MaskedArray");
    if (!py::isinstance(given, masked)) return given;
    return given.attr("filled")(std::numeric_limits<double>::quiet_NaN());
}

/// An array of float32 or float64, without a copy unless it is masked.
py::array floats_from(const py::object& given, const char* name, const char* expected) {
    const py::array array = py::array::ensure(without_mask(given));
    if (!array) {
        throw py::type_error(
            fmt::format("{}: expected an array {} of float32 or float64", name, expected));
    }
    if (!is_single(array) && !py::isinstance<py::array_t<double>>(array)) {
        throw py::type_error(
            fmt::format("{}: expected float32 or float64 in this machine's byte order, got {}",
                        name, text(array.dtype())));
    }
    return array;
}

/// A sweep takes a fraction of a second. Times far outside of that have another unit, or are not
/// relative to the stamp.
void refuse_odd_times(const std::vector<float>& times, const Points& points) {
    constexpr float kFarthest = 60.0F;  // [s]
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!is_measured(points[i])) continue;
        if (!std::isfinite(times[i])) {
            throw py::value_error(
                fmt::format("times: expected finite numbers, got {} for point {}", times[i], i));
        }
        if (std::abs(times[i]) > kFarthest) {
            throw py::value_error(fmt::format(
                "times: expected seconds from the scan's stamp, got {} for point {}: are they "
                "absolute, or in another unit?",
                times[i], i));
        }
    }
}

double skewness(const Eigen::Matrix3d& r) {
    return (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

void refuse_if_not_rigid(const Eigen::Matrix4d& m) {
    const auto refuse = [](const std::string& why) {
        throw py::value_error("pose: expected a rigid transform T_world_sensor, " + why);
    };
    const Eigen::RowVector4d last_row(0, 0, 0, 1);
    if (!m.allFinite()) refuse("got numbers that are not finite");
    if (m.row(3) != last_row) {
        const bool transposed = m.col(3).transpose() == last_row;
        refuse(transposed ? "got one that is transposed: the translation is in the last row"
                          : "got a last row that is not 0 0 0 1");
    }
    const Eigen::Matrix3d r = m.topLeftCorner<3, 3>();
    if (!(skewness(r) <= 1e-3)) {
        refuse(fmt::format("got a rotation that is not orthogonal (off by {:.3g}, allowed 0.001)",
                           skewness(r)));
    }
    if (r.determinant() < 0.0) refuse("got a reflection: one axis is flipped");
}

/// The nearest rotation, by Newton's iteration. Exact rotations are not changed, so that poses of
/// recordings are bit-identical to those that the command uses.
Eigen::Matrix3d made_exact(Eigen::Matrix3d r) {
    constexpr double kExact = 1e-12;
    while (skewness(r) > kExact) {
        r = r * (1.5 * Eigen::Matrix3d::Identity() - 0.5 * r.transpose() * r);
    }
    return r;
}

py::object format_of(const io::Field& field) {
    static constexpr const char* kNames[] = {"<i1", "<u1", "<i2", "<u2", "<i4",
                                             "<u4", "<i8", "<u8", "<f4", "<f8"};
    const py::str name(kNames[static_cast<std::size_t>(field.type)]);
    if (field.count == 1) return name;
    return py::make_tuple(name, py::make_tuple(field.count));
}

/// numpy needs names that are unique and not empty.
std::string unused_name(std::string name, std::set<std::string>& used) {
    if (name.empty()) name = "_";
    while (!used.insert(name).second) name += '_';
    return name;
}

}  // namespace

Points points_from(const py::object& given) {
    const py::array array = floats_from(given, "points", "N x 3");
    if (array.ndim() != 2 || array.shape(1) < 3) {
        throw py::value_error("points: expected an array N x 3 or more columns, got shape " +
                              shape_of(array));
    }
    constexpr py::ssize_t kManyColumns = 32;
    if (array.shape(0) <= 4 && array.shape(1) > kManyColumns) {
        throw py::value_error("points: expected an array N x 3 or more columns, got shape " +
                              shape_of(array) + ": is it transposed?");
    }
    return is_single(array) ? read_points<float>(array) : read_points<double>(array);
}

std::vector<float> times_from(const py::object& given, const Points& points) {
    if (given.is_none()) return {};
    const py::array array = floats_from(given, "times", "N");
    if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != points.size()) {
        throw py::value_error(
            fmt::format("times: expected an array N, one for each of the {} points, got shape {}",
                        points.size(), shape_of(array)));
    }
    std::vector<float> times =
        is_single(array) ? read_times<float>(array) : read_times<double>(array);
    refuse_odd_times(times, points);
    return times;
}

Pose pose_from(const py::object& given) {
    const auto array =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
    if (!array) throw py::type_error("pose: expected a matrix 4 x 4 of numbers, T_world_sensor");
    if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
        throw py::value_error("pose: expected a matrix 4 x 4, T_world_sensor, got shape " +
                              shape_of(array));
    }
    const Eigen::Matrix4d m =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.data());
    refuse_if_not_rigid(m);
    Pose pose(m);
    pose.linear() = made_exact(m.topLeftCorner<3, 3>());
    return pose;
}

py::array labels_array(Labels labels) {
    const auto [kept, owner] = handed_over(std::move(labels));
    return labels_array(kept, owner);
}

py::array labels_array(const Labels& labels, py::handle owner) {
    static_assert(sizeof(Label) == 1);
    return py::array(py::dtype::of<std::uint8_t>(), {labels.size()}, labels.data(), owner);
}

py::array points_array(const Points& points, py::handle owner) {
    static_assert(sizeof(Point) == 3 * sizeof(float));
    return py::array(py::dtype::of<float>(), {points.size(), std::size_t{3}}, points.data(), owner);
}

py::array pose_array(const Pose& pose, py::handle owner) {
    constexpr py::ssize_t kSize = sizeof(double);
    return py::array(py::dtype::of<double>(), {4, 4}, {kSize, 4 * kSize}, pose.data(), owner);
}

py::array poses_array(std::span<const Pose> poses) {
    constexpr py::ssize_t kRows = 4;
    py::array_t<double> array({static_cast<py::ssize_t>(poses.size()), kRows, kRows});
    using Rows = Eigen::Matrix<double, kRows, kRows, Eigen::RowMajor>;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        Eigen::Map<Rows>(array.mutable_data(static_cast<py::ssize_t>(i))) = poses[i].matrix();
    }
    return array;
}

py::array times_array(const std::vector<float>& times, py::handle owner) {
    return py::array(py::dtype::of<float>(), {times.size()}, times.data(), owner);
}

py::array fields_array(const io::Cloud& cloud, py::handle owner) {
    py::list names, formats, offsets;
    std::set<std::string> used;
    for (const io::Field& field : cloud.fields) {
        names.append(unused_name(field.name, used));
        formats.append(format_of(field));
        offsets.append(field.offset);
    }
    const py::dtype record(names, formats, offsets, static_cast<py::ssize_t>(cloud.point_bytes));
    return py::array(record, {cloud.size()}, cloud.data.data(), owner);
}

}  // namespace dynamic_filter::python
