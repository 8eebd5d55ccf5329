// SPDX-License-Identifier: MIT
#include "module.hpp"

#include "dynamic_filter/error.hpp"

PYBIND11_MODULE(_dynamicfilter, module) {
    namespace py = pybind11;
    using namespace dynamic_filter;
    module.attr("__version__") = DYNAMIC_FILTER_VERSION;
    // Users see the contents of the module under this name.
    module.attr("__name__") = "dynamicfilter";
    const auto& error = py::register_exception<Error>(module, "Error");
    py::register_exception<ConfigError>(module, "ConfigError", error);
    py::register_exception<InputError>(module, "InputError", error);
    py::register_exception<OutputError>(module, "OutputError", error);
    error.attr("__doc__") =
        "Base class of all errors of this package; the message is one sentence.";
    module.attr("ConfigError").attr("__doc__") = "A setting or an argument is wrong.";
    module.attr("InputError").attr("__doc__") = "An input cannot be read, or contradicts itself.";
    module.attr("OutputError").attr("__doc__") = "An output cannot be written.";
    python::bind_filter(module);
    python::bind_recordings(module);
    python::bind_programs(module);
    module.attr("__name__") = "dynamicfilter._dynamicfilter";
}
