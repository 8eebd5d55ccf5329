// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/online.hpp"
#include "python/src/module.hpp"

namespace dynamic_filter::python {

namespace py = pybind11;

namespace {

std::string value_text(const py::handle& value) {
    const std::string text = py::str(value);
    if (text == "True" || text == "False")
        return text == "True" ? "true" : "false";  // also for bool of numpy
    return text;
}

void add_settings(const py::dict& settings, const std::string& section, app::ConfigOptions& to) {
    for (const auto& [name, value] : settings) {
        const std::string key = section + std::string(py::str(name));
        if (py::isinstance<py::dict>(value)) {
            add_settings(py::reinterpret_borrow<py::dict>(value), key + ".", to);
        } else if (key == "preset") {
            to.preset = value_text(value);
        } else {
            to.assignments.push_back(key + "=" + value_text(value));
        }
    }
}

void refuse_other(const char* name, const std::string& value,
                  const std::vector<std::string>& choices) {
    if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
    throw ConfigError(fmt::format("{}: '{}' is none of {}", name, value, fmt::join(choices, ", ")));
}

}  // namespace

app::ConfigOptions config_options(const py::object& given) {
    app::ConfigOptions options;
    options.assigned_by = "config: ";
    if (given.is_none()) return options;
    if (py::isinstance<py::dict>(given)) {
        add_settings(given, "", options);
        return options;
    }
    const bool is_text = py::isinstance<py::str>(given);
    if (!is_text && !py::hasattr(given, "__fspath__")) {
        throw py::type_error(
            "config: expected None, the name of a preset, the path of a TOML file, or a dict of "
            "settings");
    }
    const auto path = given.cast<std::filesystem::path>();
    // A name without dot and slash is a preset, or a mistake; the message then lists the presets.
    if (is_text && !path.has_extension() && !path.has_parent_path()) {
        options.preset = path.string();
    } else {
        options.file = path;
    }
    return options;
}

void pop_switch(py::dict& options, const char* name, std::string& to) {
    if (!options.contains(name)) return;
    const py::object value = options.attr("pop")(name);
    if (value.is_none()) return;
    if (py::isinstance<py::bool_>(value)) {
        to = value.cast<bool>() ? "on" : "off";
        return;
    }
    to = taken<std::string>(value, name, "True, False, or 'auto'");
    refuse_other(name, to, {"auto", "on", "off"});
}

app::DataOptions data_options(const std::filesystem::path& data, py::dict& options) {
    app::DataOptions o;
    o.data = data;
    app::visit_reading(o, [&](const app::ReadingOption& option, auto& value) {
        if constexpr (std::is_same_v<decltype(value), std::string&>) {
            if (option.alone != nullptr) return pop_switch(options, option.name, value);
        }
        pop_option(options, option.name, value);
    });
    app::refuse_invalid(o, app::Asker::python);
    return o;
}

void refuse_threads(int threads) {
    for (const std::string& fault : violations(OnlineOptions{.threads = threads})) {
        throw py::value_error(fault);
    }
}

void refuse_unknown(const char* function, const py::dict& options) {
    for (const auto& [name, value] : options) {
        throw py::type_error(fmt::format("{}() got an unexpected keyword argument '{}'", function,
                                         std::string(py::str(name))));
    }
}

}  // namespace dynamic_filter::python
