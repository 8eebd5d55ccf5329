// SPDX-License-Identifier: MIT
/// The parts of the module `_dynamicfilter`. dynamicfilter/__init__.pyi declares what users see;
/// the documentation of each function is in its binding.
#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include "recording/data_options.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::python {

void bind_filter(pybind11::module_& module);
void bind_recordings(pybind11::module_& module);
void bind_programs(pybind11::module_& module);

/// Reads None, the name of a preset, a TOML file, or a dict of settings (flat or by section;
/// `preset` names the preset that they change). Raises TypeError.
app::ConfigOptions config_options(const pybind11::object& given);

/// Moves an option, if it is given and not None, to its place. Raises TypeError.
template <class T>
void pop_option(pybind11::dict& options, const char* name, T& to) {
    if (!options.contains(name)) return;
    const pybind11::object value = options.attr("pop")(name);
    if (value.is_none()) return;
    try {
        to = value.cast<T>();
    } catch (const pybind11::cast_error&) {
        throw pybind11::type_error(fmt::format(
            "{}: cannot take {} {}", name, std::string(pybind11::str(pybind11::type::of(value))),
            std::string(pybind11::repr(value))));
    }
}

/// Converts an argument to the required type. Raises TypeError, which names the argument.
template <class T>
T taken(const pybind11::object& value, const char* name, const char* expected) {
    try {
        return value.cast<T>();
    } catch (const pybind11::cast_error&) {
        throw pybind11::type_error(fmt::format("{}: expected {}, got {}", name, expected,
                                               std::string(pybind11::repr(value))));
    }
}

/// Moves an option that is True, False, "auto", "on" or "off" to its place, if it is given and not
/// None. Raises TypeError, throws ConfigError.
void pop_switch(pybind11::dict& options, const char* name, std::string& to);

/// Removes the options about reading a recording from `options`. Raises TypeError, throws
/// ConfigError.
app::DataOptions data_options(const std::filesystem::path& data, pybind11::dict& options);

/// A message with the command's options in it, with Python's arguments in their place:
/// `--pose-fix inverse` becomes `pose_fix="inverse"`.
std::string in_python(const std::string& message);

/// Raises ValueError if the number of threads is not possible.
void refuse_threads(int threads);

/// Raises TypeError if any option is left.
void refuse_unknown(const char* function, const pybind11::dict& options);

}  // namespace dynamic_filter::python
