// SPDX-License-Identifier: MIT
#include "python/src/module.hpp"

#include "dynamic_filter/error.hpp"

PYBIND11_MODULE(_dynamicfilter, module) {
    namespace py = pybind11;
    using namespace dynamic_filter;
    module.attr("__version__") = DYNAMIC_FILTER_VERSION;
    // Users see the contents of the module under this name.
    module.attr("__name__") = "dynamicfilter";
    // They live as long as the interpreter.
    static const py::exception<Error> error(module, "Error");
    static const py::exception<ConfigError> config_error(module, "ConfigError", error);
    static const py::exception<InputError> input_error(module, "InputError", error);
    static const py::exception<OutputError> output_error(module, "OutputError", error);
    py::register_exception_translator([](std::exception_ptr thrown) {
        const auto raise = [](const py::handle& type, const std::exception& e) {
            PyErr_SetString(type.ptr(), python::in_python(e.what()).c_str());
        };
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const ConfigError& e) {
            raise(config_error, e);
        } catch (const InputError& e) {
            raise(input_error, e);
        } catch (const OutputError& e) {
            raise(output_error, e);
        } catch (const Error& e) {
            raise(error, e);
        }
    });
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
