// The class cascade._core.Pattern: a Pattern of include/cascade/cascade.h for Python.
#pragma once

#include "cascade/cascade.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <utility>

namespace cascade {

namespace py = pybind11;

/// An error that Python receives as an exception cascade.Error.
struct Fault {
    Message problem;
    std::string text;
};

/// How often this process has been forked from another one since the module was loaded. Unlike
/// getpid(), this is no system call, which would take longer than a small step.
int forks();

/// A pattern that only one thread may use at a time. While the pattern takes steps, other Python
/// threads run.
class PythonPattern {
public:
    /// Throws a Fault if the script has errors or its run cannot begin.
    explicit PythonPattern(Pattern pattern);
    PythonPattern(const PythonPattern&) = delete;
    PythonPattern& operator=(const PythonPattern&) = delete;
    ~PythonPattern();

    /// The pattern, even after a failure. Throws an error if another thread is using the pattern.
    /// Also throws after a fork of the process, because the pattern's threads are then missing.
    Pattern& own() {
        if (!pattern_ || is_busy_ || forks_ != forks()) refuse_use();
        return *pattern_;
    }
    /// The pattern. Throws a Fault if it has failed.
    Pattern& running() {
        Pattern& pattern = own();
        if (!pattern.ok()) fail();
        return pattern;
    }
    /// Throws the pattern's last error.
    [[noreturn]] void fail();
    void check(bool is_done) {
        if (!is_done) fail();
    }
    void cancel();

    /// Makes a call of the pattern, during which other Python threads may run.
    template <typename Call>
    auto during(const Call& call) {
        Pattern& pattern = running();
        const Busy busy(is_busy_);
        const py::gil_scoped_release others;
        return call(pattern);
    }
    /// Makes a call that gets a ProgressWatcher. The call ends early at Ctrl-C, if `watch` returns
    /// False, or if `watch` raises an exception, which is thrown after the call. `watch` may be
    /// None.
    template <typename Call>
    auto watched(const py::object& watch, const Call& call) {
        Watch watching{watch, nullptr};
        auto result = during([&](Pattern& pattern) {
            return call(pattern, [&](const PatternProgress& now) { return watching.goes_on(now); });
        });
        if (watching.thrown) std::rethrow_exception(watching.thrown);
        return result;
    }

    /// Memory for an object, filled with zeros. If __init__ of the object is never called,
    /// `pattern_` stays null, which own() recognises.
    static void* operator new(std::size_t size) {
        void* const memory = std::calloc(1, size);
        if (memory == nullptr) throw std::bad_alloc();
        return memory;
    }
    static void operator delete(void* memory) { std::free(memory); }

private:
    /// Marks a pattern as used by another thread, also if the call throws.
    class Busy {
    public:
        explicit Busy(bool& flag) : flag_(flag) { flag_ = true; }
        ~Busy() { flag_ = false; }
        Busy(const Busy&) = delete;
        Busy& operator=(const Busy&) = delete;

    private:
        bool& flag_;
    };
    struct Watch {
        const py::object& function;
        std::exception_ptr thrown;
        bool goes_on(const PatternProgress& progress);
    };
    [[noreturn]] void refuse_use() const;

    std::unique_ptr<Pattern> pattern_;
    int forks_ = 0;         ///< The value of forks() when the pattern was made.
    bool is_busy_ = false;  ///< Read and written only while Python's global lock is held.
};

/// Takes at most `count` steps. The call ends early at Ctrl-C, or if `watch` returns False.
std::int64_t step(PythonPattern& of, std::int64_t count, const py::object& watch);

/// The values of an expression as an array, without a copy if possible (PatternView).
py::array values(PythonPattern& of, const std::string& expression, bool copy);
/// Sets an item to the numbers of an array of the same shape.
void set_values(PythonPattern& of, const std::string& item, const py::array& numbers);
/// The number of slices, rows and columns. Numbers that are 1 are left out.
py::tuple shape(PythonPattern& of);
/// The arrays of a model, by name.
py::dict model(PythonPattern& of);

/// Adds the classes of messages, parameters and progress, and cascade.Error.
void define_values(py::module_& module);
void define_error(py::module_& module);

}  // namespace cascade
