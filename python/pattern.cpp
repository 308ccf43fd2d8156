// Calls of a pattern by several Python threads, after a fork, and with Ctrl-C.
#include "python/pattern.h"

#include <pthread.h>

#include <stdexcept>

namespace cascade {
namespace {

[[noreturn]] void raise(const Message& problem, std::string text) {
    throw Fault{problem, text.empty() ? problem.text : std::move(text)};
}

int forks_so_far = 0;

}  // namespace

int forks() {
    static const int error = pthread_atfork(nullptr, nullptr, [] { ++forks_so_far; });
    if (error != 0) throw std::bad_alloc();
    return forks_so_far;
}

PythonPattern::PythonPattern(Pattern pattern)
    : pattern_(std::make_unique<Pattern>(std::move(pattern))), forks_(forks()) {
    if (pattern_->ok()) return;
    const std::string error = pattern_->error();
    raise(pattern_->problem(), error.empty() ? pattern_->messages() : error);
}

PythonPattern::~PythonPattern() {
    // After a fork, the threads for which the pattern's destructor would wait exist only in the
    // parent process.
    if (forks_ != forks()) (void)pattern_.release();
}

void PythonPattern::refuse_use() const {
    if (!pattern_) throw py::type_error("Pattern.__init__() has not been called");
    if (forks_ != forks()) {
        throw std::runtime_error(
            "this pattern belongs to the process that was forked; make patterns in the process that "
            "uses them, or send them by pickle");
    }
    throw std::runtime_error(
        "this pattern takes steps in another call; only cancel() can be called meanwhile");
}

void PythonPattern::fail() { raise(pattern_->problem(), pattern_->error()); }

void PythonPattern::cancel() {
    if (!pattern_) refuse_use();
    pattern_->cancel();
}

bool PythonPattern::Watch::goes_on(const PatternProgress& progress) {
    const py::gil_scoped_acquire python;
    if (thrown) return false;
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        return function.is_none() || !function(progress).is(py::bool_(false));
    } catch (...) {
        thrown = std::current_exception();
        return false;
    }
}

std::int64_t step(PythonPattern& of, std::int64_t count, const py::object& watch) {
    if (count < 0) throw py::value_error("the number of steps is negative");
    // A single step takes little time, so its progress need not be watched.
    const bool is_single = count == 1 && watch.is_none();
    const std::int64_t taken =
        is_single ? of.during([](Pattern& pattern) { return pattern.step(1); })
                  : of.watched(watch, [&](Pattern& pattern, const ProgressWatcher& watcher) {
                        return pattern.step(count, watcher);
                    });
    of.check(of.own().ok());
    return taken;
}

}  // namespace cascade
