// The module cascade._core: Pattern of include/cascade/cascade.h for Python. What is easier to
// write in Python, such as bars of progress, is in python/cascade.
#include "cascade/cascade.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace py::literals;

namespace cascade {
namespace {

/// What becomes a cascade.Error.
struct Fault {
    Message problem;
    std::string text;
};

[[noreturn]] void raise(const Message& problem, std::string text) {
    throw Fault{problem, text.empty() ? problem.text : std::move(text)};
}

/// A pattern that one thread uses at a time. While it takes steps, other threads of Python run.
class PythonPattern {
public:
    explicit PythonPattern(Pattern pattern) : pattern_(std::move(pattern)) {
        if (pattern_.ok()) return;
        const std::string error = pattern_.error();
        raise(pattern_.problem(), error.empty() ? pattern_.messages() : error);
    }

    /// The pattern, for a call by one thread.
    Pattern& own() {
        if (is_busy_) {
            throw std::runtime_error(
                "this pattern takes steps in another call; only cancel() can be called meanwhile");
        }
        return pattern_;
    }
    Pattern& running() {
        Pattern& pattern = own();
        if (!pattern.ok()) fail();
        return pattern;
    }
    [[noreturn]] void fail() { raise(pattern_.problem(), pattern_.error()); }
    void check(bool is_done) {
        if (!is_done) fail();
    }
    void cancel() { pattern_.cancel(); }

    /// Takes steps, during which Ctrl-C and exceptions of `watch` end the call.
    std::int64_t step(std::int64_t count, const py::object& watch) {
        if (count < 0) throw py::value_error("the number of steps is negative");
        Pattern& pattern = running();
        std::exception_ptr thrown;
        const ProgressWatcher watcher = [&](const PatternProgress& progress) {
            const py::gil_scoped_acquire python;
            if (thrown) return false;
            try {
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                return watch.is_none() || !watch(progress).is(py::bool_(false));
            } catch (...) {
                thrown = std::current_exception();
                return false;
            }
        };
        std::int64_t taken = 0;
        is_busy_ = true;
        {
            const py::gil_scoped_release others;
            // A single step ends soon, and is looked at by nobody.
            taken = count == 1 && watch.is_none() ? pattern.step(1) : pattern.step(count, watcher);
        }
        is_busy_ = false;
        if (thrown) std::rethrow_exception(thrown);
        check(pattern.ok());
        return taken;
    }

    py::array values(const std::string& expression, bool copy) {
        Pattern& pattern = running();
        PatternView view = pattern.view(expression);
        if (view.data == nullptr) fail();
        const bool is_single = view.number == PatternView::Number::binary32;
        const py::dtype type = is_single ? py::dtype::of<float>() : py::dtype::of<double>();
        std::vector<py::ssize_t> shape, strides;
        const auto add = [&](std::int64_t cells, std::int64_t bytes) {
            shape.push_back(cells);
            strides.push_back(bytes);
        };
        if (view.depth > 1) add(view.depth, view.slice_bytes);
        if (view.height > 1) add(view.height, view.row_bytes);
        add(view.width, type.itemsize());
        if (copy) return py::array(type, shape, strides, view.data);  // Without an owner: copied.
        auto* const owner = new std::shared_ptr<const void>(std::move(view.owner));
        const py::capsule base(owner, [](void* kept) {
            delete static_cast<std::shared_ptr<const void>*>(kept);
        });
        py::array array(type, shape, strides, view.data, base);
        array.attr("flags").attr("writeable") = false;
        return array;
    }

private:
    Pattern pattern_;
    bool is_busy_ = false;  ///< Read and set only under Python's lock.
};

using Seed = std::optional<std::uint32_t>;

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

/// Makes a pattern while other threads of Python run, since the cells of a model take long.
PythonPattern made(const std::function<Pattern()>& make) {
    const py::gil_scoped_release others;
    return PythonPattern(make());
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
    const std::string file = of.running().picture(expression);
    of.check(!file.empty());
    return file;
}

py::tuple shape(PythonPattern& of) {
    const Pattern& pattern = of.own();
    if (pattern.depth() > 1)
        return py::make_tuple(pattern.depth(), pattern.height(), pattern.width());
    if (pattern.height() > 1) return py::make_tuple(pattern.height(), pattern.width());
    return py::make_tuple(pattern.width());
}

/// cascade.Error, an exception with the attributes of a message.
void define_error(py::module_& module) {
    static PyObject* error = nullptr;
    error = PyErr_NewExceptionWithDoc(
        "cascade.Error",
        "A script, expression or change is wrong, or a run has failed.\n\n"
        "str() is the whole text, as the command line draws it. Attributes: message,\n"
        "hint (what to write instead; may be empty), file, line and column (from 1;\n"
        "0 without a place).",
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
    py::class_<Message>(module, "Message", "A fault or warning of a script.")
        .def_readonly("is_error", &Message::is_error)
        .def_readonly("file", &Message::file)
        .def_readonly("line", &Message::line)
        .def_readonly("column", &Message::column)
        .def_readonly("text", &Message::text)
        .def_readonly("hint", &Message::hint)
        .def("__repr__", [](const Message& message) {
            return message.file + ":" + std::to_string(message.line) + ":" +
                   std::to_string(message.column) + ": " +
                   (message.is_error ? "error: " : "warning: ") + message.text;
        });
    const auto of_range = [](auto member) {
        return [member](const PatternParameter& parameter) {
            return parameter.range ? std::optional<double>((*parameter.range).*member)
                                   : std::nullopt;
        };
    };
    py::class_<PatternParameter>(module, "Parameter", "A parameter of a stage.")
        .def_readonly("stage", &PatternParameter::stage)
        .def_readonly("name", &PatternParameter::name)
        .def_readonly("doc", &PatternParameter::doc, "Its doc comment; may be empty.")
        .def_readonly("is_uniform", &PatternParameter::is_uniform, "One number for all cells.")
        .def_readonly("value", &PatternParameter::value,
                      "NaN if it varies, or if its stage has not begun.")
        .def_property_readonly("low", of_range(&PatternParameter::Range::low),
                               "Of its range; None without one.")
        .def_property_readonly("high", of_range(&PatternParameter::Range::high),
                               "Of its range; None without one.")
        .def_property_readonly(
            "step",
            [](const PatternParameter& parameter) {
                return parameter.range ? parameter.range->step : std::nullopt;
            },
            "Of its range; None without one.")
        .def("__float__", [](const PatternParameter& parameter) { return parameter.value; })
        .def("__repr__", [](const PatternParameter& parameter) {
            return "<" + parameter.stage + "." + parameter.name + " = " +
                   (parameter.is_uniform ? std::string(py::str(py::float_(parameter.value)))
                                         : "varies") +
                   ">";
        });
    py::class_<PatternProgress>(module, "Progress", "How far a stage has come.")
        .def_readonly("stage", &PatternProgress::stage)
        .def_readonly("stage_number", &PatternProgress::stage_number)
        .def_readonly("stage_count", &PatternProgress::stage_count)
        .def_readonly("step", &PatternProgress::step, "Complete steps of this stage.")
        .def_readonly("steps", &PatternProgress::steps, "Steps that it will take.")
        .def_readonly("t", &PatternProgress::t, "Its time, if it ends at a time.")
        .def_readonly("duration", &PatternProgress::duration,
                      "That end; 0 if it ends after some steps.")
        .def_readonly("steps_per_second", &PatternProgress::steps_per_second, "0 while unknown.")
        .def_readonly("seconds_left", &PatternProgress::seconds_left,
                      "Of this stage; negative while unknown.");
}

constexpr const char* about_values =
    "The numbers of an expression in all cells, such as 'b', 'stage1.b' or 'a - b', as an array of\n"
    "float32, or of float64 with `precision: double`. Its shape is (height, width), in volumes\n"
    "(depth, height, width), and (cells,) for lines, models and cells that crawl.\n\n"
    "A species, and a parameter that varies, is shown without a copy where the grid has no mask. The\n"
    "array shows the moment at which it was asked for, also after further steps and after the pattern\n"
    "is gone: as long as it is kept, the next step goes on in a copy of that plane. So it is read-only;\n"
    "copy=True gives an array of your own.";

}  // namespace
}  // namespace cascade

PYBIND11_MODULE(_core, module) {
    using namespace cascade;
    module.attr("__version__") = library_version();
    define_error(module);
    define_values(module);
    const auto changed = [](bool (Pattern::*change)()) {
        return [change](PythonPattern& of) { of.check((of.running().*change)()); };
    };
    py::class_<PythonPattern>(module, "Pattern")
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
             py::kw_only(), "session"_a, "folder"_a, "threads"_a, "native"_a)
        .def(
            "step", &PythonPattern::step, "count"_a = 1, "watch"_a = py::none(),
            "Takes up to `count` steps, and continues with the next stage when one ends. Returns how many\n"
            "were taken. Ctrl-C ends the call after the present step, and the pattern can go on. `watch` gets\n"
            "the Progress ten times a second; where it returns False, the call ends, too.")
        .def("values", &PythonPattern::values, "expression"_a, py::kw_only(), "copy"_a = false,
             about_values)
        .def("__getitem__",
             [](PythonPattern& of, const std::string& expression) {
                 return of.values(expression, false);
             })
        .def("cancel", &PythonPattern::cancel,
             "Makes a step() or run() of another thread return after its present step.")
        .def(
            "set",
            [](PythonPattern& of, const std::string& name, double value) {
                of.check(of.running().set(name, value));
            },
            "name"_a, "value"_a,
            "Gives a parameter or setting another value: 'ka' in all stages, or 'spots.ka' in one.\n"
            "A string is an expression, as `--set` takes it: '1/80'.")
        .def(
            "set",
            [](PythonPattern& of, const std::string& name, const std::string& expression) {
                of.check(of.running().set(name, expression));
            },
            "name"_a, "value"_a)
        .def(
            "set_script",
            [](PythonPattern& of, const std::string& script) {
                of.check(of.running().set_script(script));
            },
            "script"_a, "Continues with another script. Items of the same name keep their values.")
        .def(
            "paint",
            [](PythonPattern& of, const std::string& item, const std::string& expression) {
                of.check(of.running().paint(item, expression));
            },
            "item"_a, "expression"_a,
            "Gives a species, or a varying parameter or `frozen`, the values of an expression over the\n"
            "present state of the current stage: paint('b', 'if(disc(0.5, 0.5, 0.1) > 0, 8, b)').")
        .def("begin_next_stage", changed(&Pattern::begin_next_stage),
             "Ends the current stage at its present step and begins the next one.")
        .def("undo", changed(&Pattern::undo),
             "Returns to the moment before the last change, to the bit.")
        .def("redo", changed(&Pattern::redo), "Makes the change again that undo() has taken back.")
        .def(
            "session", [](PythonPattern& of) { return py::bytes(of.running().session()); },
            "The log of all steps and changes, from which Pattern.play() grows the same pattern.")
        .def(
            "save",
            [](PythonPattern& of, const std::string& folder) {
                of.check(of.running().save(folder));
            },
            "folder"_a,
            "Saves all values in a folder, which Pattern() opens and `cascade run --resume` goes on from.")
        .def(
            "features", &features, "expression"_a = "",
            "Wavelength, spots, area and other measures of the picture, or of an expression, by name.\n"
            "NaN marks those that the pattern lacks.")
        .def("picture", &picture, "expression"_a = "",
             "What `cascade run` would draw now, or an expression, as the bytes of a PNG file.")
        .def(
            "write_picture",
            [](PythonPattern& of, const std::string& path, const std::string& expression) {
                of.check(of.running().write_picture(path, expression));
            },
            "path"_a, "expression"_a = "", "Writes picture() to a file whose name ends in .png.")
        .def("_repr_png_", [](PythonPattern& of) { return picture(of, ""); })
        .def("_analysis",
             [](PythonPattern& of, const std::string& stage, bool as_json) {
                 std::string report = of.running().analysis(stage, as_json);
                 of.check(!report.empty());
                 return report;
             })
        .def("_parameters", [](PythonPattern& of) { return of.own().parameters(); })
        .def(
            "species",
            [](PythonPattern& of, const std::string& stage) {
                const Pattern& pattern = of.own();
                return pattern.species(stage.empty() ? pattern.current_stage() : stage);
            },
            "stage"_a = "", "Names of the species of a stage, or of the current one.")
        .def_property_readonly(
            "remarks", [](PythonPattern& of) { return of.own().remarks(); },
            "What `cascade run` would remark on the stages so far, a sentence each.")
        .def_property_readonly(
            "messages", [](PythonPattern& of) { return of.own().diagnostics(); },
            "The warnings of the script.")
        .def_property_readonly(
            "stages", [](PythonPattern& of) { return of.own().stages(); },
            "Names of the stages, in order.")
        .def_property_readonly(
            "stage", [](PythonPattern& of) { return of.own().current_stage(); },
            "The stage that steps are taken in now, the last one when finished.")
        .def_property_readonly(
            "steps", [](PythonPattern& of) { return of.own().steps(); },
            "Complete steps of the current stage.")
        .def_property_readonly(
            "finished", [](PythonPattern& of) { return of.own().finished(); },
            "Has every stage taken all its steps?")
        .def_property_readonly(
            "shape", &shape,
            "The cells of the domain: (height, width), in volumes (depth, height, width), and (cells,) for lines and\n"
            "models. It is the shape of values(), but for cells that crawl, whose number changes.");
}
