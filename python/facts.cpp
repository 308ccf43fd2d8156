// The classes of errors, messages, parameters and progress.
#include "python/pattern.h"

#include <pybind11/stl.h>

#include <exception>
#include <optional>

namespace cascade {
namespace {

void define_message(py::module_& module) {
    py::class_<Message>(module, "Message", "An error or a warning about a script.")
        .def_readonly("is_error", &Message::is_error, "False for a warning.")
        .def_readonly("file", &Message::file, "The name of the script, option or expression.")
        .def_readonly("line", &Message::line, "The line, from 1.")
        .def_readonly("column", &Message::column, "The column, from 1.")
        .def_readonly("text", &Message::text, "What is wrong.")
        .def_readonly("hint", &Message::hint, "What to write instead; may be empty.")
        .def("__repr__", [](const Message& message) {
            return message.file + ":" + std::to_string(message.line) + ":" +
                   std::to_string(message.column) + ": " +
                   (message.is_error ? "error: " : "warning: ") + message.text;
        });
}

void define_parameter(py::module_& module) {
    const auto of_range = [](auto member) {
        return [member](const PatternParameter& parameter) {
            return parameter.range ? std::optional<double>((*parameter.range).*member)
                                   : std::nullopt;
        };
    };
    py::class_<PatternParameter>(module, "Parameter", "A parameter of a stage.")
        .def_readonly("stage", &PatternParameter::stage, "The name of its stage.")
        .def_readonly("name", &PatternParameter::name, "Its name in the script.")
        .def_readonly("doc", &PatternParameter::doc, "The doc comment in the script; may be empty.")
        .def_readonly("is_uniform", &PatternParameter::is_uniform,
                      "True if the value is the same in all cells.")
        .def_readonly("value", &PatternParameter::value,
                      "The present number; NaN if it varies, or if the stage has not begun.")
        .def_property_readonly("low", of_range(&PatternParameter::Range::low),
                               "The lower end of the range; None if it has no range.")
        .def_property_readonly("high", of_range(&PatternParameter::Range::high),
                               "The upper end of the range; None if it has no range.")
        .def_property_readonly(
            "step",
            [](const PatternParameter& parameter) {
                return parameter.range ? parameter.range->step : std::nullopt;
            },
            "The step of the range; None if it has no range.")
        .def("__float__", [](const PatternParameter& parameter) { return parameter.value; })
        .def("__repr__", [](const PatternParameter& parameter) {
            return "<" + parameter.stage + "." + parameter.name + " = " +
                   (parameter.is_uniform ? std::string(py::str(py::float_(parameter.value)))
                                         : "varies") +
                   ">";
        });
}

void define_progress(py::module_& module) {
    py::class_<PatternProgress>(module, "Progress", "The progress of a stage.")
        .def_readonly("stage", &PatternProgress::stage, "The name of the stage.")
        .def_readonly("stage_number", &PatternProgress::stage_number, "Its number, from 1.")
        .def_readonly("stage_count", &PatternProgress::stage_count, "How many stages there are.")
        .def_readonly("step", &PatternProgress::step, "Complete steps of the current stage.")
        .def_readonly("steps", &PatternProgress::steps, "Steps that the stage will take.")
        .def_readonly("t", &PatternProgress::t, "The time of the stage, if it ends at a time.")
        .def_readonly("duration", &PatternProgress::duration,
                      "The time at which the stage ends; 0 if it ends after a number of steps.")
        .def_readonly("steps_per_second", &PatternProgress::steps_per_second, "0 while unknown.")
        .def_readonly("seconds_left", &PatternProgress::seconds_left,
                      "Seconds until the stage ends; negative while unknown.");
}

}  // namespace

/// Defines an exception with the attributes of a message.
void define_error(py::module_& module) {
    static PyObject* error = nullptr;
    error = PyErr_NewExceptionWithDoc(
        "cascade.Error",
        "A script, expression or change is wrong, or a run has failed.\n\n"
        "str() returns the whole text, as the command line prints it. Attributes: message,\n"
        "hint (what to write instead; may be empty), file, line and column (from 1;\n"
        "0 if the error has no position).",
        PyExc_ValueError, nullptr);
    for (const char* text : {"message", "hint", "file"}) py::handle(error).attr(text) = "";
    for (const char* place : {"line", "column"}) py::handle(error).attr(place) = 0;
    module.add_object("Error", error);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Fault& fault) {
            const py::object made = py::handle(error)(fault.text);
            made.attr("message") = fault.problem.text;
            made.attr("hint") = fault.problem.hint;
            made.attr("file") = fault.problem.file;
            made.attr("line") = fault.problem.line;
            made.attr("column") = fault.problem.column;
            PyErr_SetObject(error, made.ptr());
        }
    });
}

void define_values(py::module_& module) {
    define_message(module);
    define_parameter(module);
    define_progress(module);
}

}  // namespace cascade
