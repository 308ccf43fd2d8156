// The module cascade._core, which makes the class Pattern of include/cascade/cascade.h available to
// Python. Parts that are easier to write in Python, such as progress bars, are in python/cascade.
#include "python/pattern.h"

#include <pybind11/stl.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {
namespace {

using namespace py::literals;

using Seed = std::optional<std::uint32_t>;
using PatternClass = py::class_<PythonPattern>;

PatternOptions options(const std::string& folder, int threads, bool native,
                       std::vector<std::string> sets, Seed seed) {
    PatternOptions made;
    made.folder = folder;
    made.threads = threads;
    made.native_code = native;
    made.sets = std::move(sets);
    made.seed = seed;
    return made;
}

/// Makes a pattern. Other Python threads may run meanwhile, because making the cells of a model
/// takes long.
std::unique_ptr<PythonPattern> made(const std::function<Pattern()>& make) {
    const py::gil_scoped_release others;
    return std::make_unique<PythonPattern>(make());
}

void define_beginnings(PatternClass& pattern) {
    pattern
        .def(py::init([](const std::string& script, const std::string& folder, int threads,
                         bool native, std::vector<std::string> sets, Seed seed) {
                 return made(
                     [&] { return Pattern(script, options(folder, threads, native, sets, seed)); });
             }),
             "script"_a, "folder"_a, "threads"_a, "native"_a, "sets"_a, "seed"_a)
        .def(py::init([](const std::string& path, int threads, bool native,
                         std::vector<std::string> sets, Seed seed) {
                 return made(
                     [&] { return Pattern::open(path, options("", threads, native, sets, seed)); });
             }),
             py::kw_only(), "path"_a, "threads"_a, "native"_a, "sets"_a, "seed"_a)
        .def(py::init(
                 [](const py::bytes& session, const std::string& folder, int threads, bool native) {
                     const std::string bytes = session;
                     return made([&] {
                         return Pattern::play(bytes, options(folder, threads, native, {}, {}));
                     });
                 }),
             py::kw_only(), "session"_a, "folder"_a, "threads"_a, "native"_a);
}

void define_steps(PatternClass& pattern) {
    pattern
        .def(
            "step", &step, "count"_a = 1, "watch"_a = py::none(),
            "Takes up to `count` steps, and continues with the next stage when one ends. Returns how many\n"
            "were taken. Ctrl-C ends the call after the present step, and later calls can continue. `watch`\n"
            "is called with the Progress ten times a second. If it returns False, the call ends as well.")
        .def(
            "cancel", &PythonPattern::cancel,
            "Makes a step(), run() or film() in another thread return after the step that it is taking.");
}

/// Makes a Python method of a function of Pattern that returns whether it was successful.
template <typename... Arguments>
auto doing(bool (Pattern::*function)(Arguments...)) {
    return [function](PythonPattern& of, Arguments... arguments) {
        of.check((of.running().*function)(arguments...));
    };
}
/// Does the same as doing(), but other Python threads may run during the call.
template <typename... Arguments>
auto doing_long(bool (Pattern::*function)(Arguments...)) {
    return [function](PythonPattern& of, Arguments... arguments) {
        of.check(of.during([&](Pattern& pattern) { return (pattern.*function)(arguments...); }));
    };
}

void define_changes(PatternClass& pattern) {
    pattern
        .def(
            "set", doing(py::overload_cast<const std::string&, double>(&Pattern::set)), "name"_a,
            "value"_a,
            "Changes the value of a parameter or setting: 'ka' in all stages, or 'spots.ka' in one.\n"
            "A string is an expression, as `--set` takes it: '1/80'.")
        .def("set", doing(py::overload_cast<const std::string&, const std::string&>(&Pattern::set)),
             "name"_a, "value"_a)
        .def("set_script", doing(&Pattern::set_script), "script"_a,
             "Continues with another script. Items of the same name keep their values.")
        .def("_paint", doing(&Pattern::paint), "item"_a, "expression"_a)
        .def("_set_values", &set_values, "item"_a, "numbers"_a)
        .def("begin_next_stage", doing(&Pattern::begin_next_stage),
             "Ends the current stage at its present step and begins the next one.")
        .def("undo", doing(&Pattern::undo),
             "Returns to the moment before the last change, to the bit.")
        .def("redo", doing(&Pattern::redo), "Repeats the change that undo() has taken back.");
}

std::string text(PythonPattern& of, std::string (Pattern::*function)()) {
    std::string made = of.during([&](Pattern& pattern) { return (pattern.*function)(); });
    of.check(!made.empty());
    return made;
}

py::dict features(PythonPattern& of, const std::string& expression) {
    py::dict made;
    for (const PatternFeature& feature : of.running().features(expression)) {
        made[py::str(feature.name)] = feature.value;
    }
    of.check(!made.empty());
    return made;
}

py::bytes picture(PythonPattern& of, const std::string& expression) {
    const std::string file =
        of.during([&](Pattern& pattern) { return pattern.picture(expression); });
    of.check(!file.empty());
    return file;
}

void film(PythonPattern& of, const std::string& path, std::int64_t every,
          const std::string& options_of_film, const py::object& watch) {
    of.check(of.watched(watch, [&](Pattern& pattern, const ProgressWatcher& watcher) {
        return pattern.film(path, every, options_of_film, watcher);
    }));
}

void define_values_and_files(PatternClass& pattern) {
    pattern
        .def(
            "values", &values, "expression"_a, py::kw_only(), "copy"_a = false,
            "The numbers of an expression in all cells, such as 'b', 'stage1.b' or 'a - b', as an array of\n"
            "float32, or of float64 with `precision: double`. Its shape is (height, width), in volumes\n"
            "(depth, height, width), and (cells,) for lines, models and cells that crawl.\n\n"
            "A species, and a parameter that varies, is shown without a copy where the grid has no mask. The\n"
            "array keeps the values of the moment of the call, even after further steps and after the pattern\n"
            "is deleted, because the next step then continues in a copy of the plane. It is read-only;\n"
            "copy=True returns an array that you may change.")
        .def("__getitem__",
             [](PythonPattern& of, const std::string& expression) {
                 return values(of, expression, false);
             })
        .def(
            "features", &features, "expression"_a = "",
            "Wavelength, spots, area and other measures of the picture, or of an expression, by name.\n"
            "A measure that the pattern does not have is NaN.")
        .def(
            "picture", &picture, "expression"_a = "",
            "Returns the picture that `cascade run` would draw now, or one of an expression, as the bytes of a PNG file.")
        .def("_repr_png_", [](PythonPattern& of) { return picture(of, ""); })
        .def(
            "session", [](PythonPattern& of) { return py::bytes(text(of, &Pattern::session)); },
            "The log of all steps and changes, from which Pattern.play() grows the same pattern.")
        .def("_save", doing_long(&Pattern::save), "folder"_a)
        .def("_write", doing_long(&Pattern::write), "path"_a, "options"_a)
        .def("_write_picture", doing_long(&Pattern::write_picture), "path"_a, "expression"_a)
        .def("_film", &film, "path"_a, "every"_a, "options"_a, "watch"_a)
        .def("_page", [](PythonPattern& of) { return text(of, &Pattern::page); })
        .def("_model", &model)
        .def("_analysis", [](PythonPattern& of, const std::string& stage, bool as_json) {
            std::string report =
                of.during([&](Pattern& its) { return its.analysis(stage, as_json); });
            of.check(!report.empty());
            return report;
        });
}

/// Makes a Python property of a function of Pattern. The property can also be read after a failure.
template <typename Value>
auto fact(Value (Pattern::*function)() const) {
    return [function](PythonPattern& of) { return (of.own().*function)(); };
}

void define_facts(PatternClass& pattern) {
    pattern.def("_parameters", fact(&Pattern::parameters))
        .def(
            "species",
            [](PythonPattern& of, const std::string& stage) {
                const Pattern& its = of.own();
                return its.species(stage.empty() ? its.current_stage() : stage);
            },
            "stage"_a = "", "Names of the species of a stage, or of the current one.")
        .def_property_readonly(
            "remarks", fact(&Pattern::remarks),
            "The remarks that `cascade run` would make on the stages so far, one sentence each.")
        .def_property_readonly("messages", fact(&Pattern::diagnostics),
                               "The warnings of the script.")
        .def_property_readonly("stages", fact(&Pattern::stages), "Names of the stages, in order.")
        .def_property_readonly("stage", fact(&Pattern::current_stage),
                               "The current stage; the last one when all have finished.")
        .def_property_readonly("steps", fact(&Pattern::steps),
                               "Complete steps of the current stage.")
        .def_property_readonly("finished", fact(&Pattern::finished),
                               "True if every stage has taken all its steps.")
        .def_property_readonly(
            "shape", &shape,
            "The numbers of cells of the domain: (height, width); (depth, height, width) for volumes; (cells,)\n"
            "for lines and models. values() has this shape, except for cells that crawl, whose number changes.");
}

}  // namespace
}  // namespace cascade

PYBIND11_MODULE(_core, module) {
    using namespace cascade;
    module.attr("__version__") = library_version();
    define_error(module);
    define_values(module);
    PatternClass pattern(module, "Pattern");
    define_beginnings(pattern);
    define_steps(pattern);
    define_changes(pattern);
    define_values_and_files(pattern);
    define_facts(pattern);
}
