// Takes the steps of a stage. An executor owns the planes that steps read and write, in any kind of
// memory, and runs the passes of a problem over them.
//
// The time loop decides how many steps are taken, and which of them are kept. It refers to planes
// by number: *copies* of all species, between which steps alternate, and scratch registers. Values
// leave an executor by fetch() and take(), and return by put(). Halos, aggregates, filters of
// waves, convolutions, constraints, norms and checks are computed by the executor.
#pragma once

#include "core/plane.h"
#include "solvers/exchange.h"
#include "solvers/part_halos.h"
#include "solvers/shared_steps.h"
#include "solvers/stage_clock.h"
#include "solvers/step_problem.h"
#include "solvers/stepping.h"
#include "solvers/tiling.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace cascade {

/// The roles of the copies of the species. Two are swapped after each step. The third, if there is
/// memory for it, is the kept copy. keep() makes the current copy the kept copy without moving a
/// byte. The next steps then alternate between the other two copies, so that back() can return to
/// the kept copy.
struct CopyRoles {
    static constexpr int none = -1;
    int kept = 0;  ///< The index of the kept copy; `none` if there are two copies.
    int current = 0;
    int last = 1;  ///< The previous current copy, which is probably still in the cache.

    /// The copy that the next step writes: neither kept nor current.
    int target() const { return kept == none || kept == current ? last : 3 - kept - current; }
    /// Called when a step is complete.
    void go_on() { last = std::exchange(current, target()); }
    /// Whether there is a kept copy. Without one, keep() does nothing, and back() must not be
    /// called.
    bool keeps() const { return kept != none; }
    void keep() {
        if (keeps()) kept = current;
    }
    void back() {
        if (current != kept) last = std::exchange(current, kept);
    }
};

/// A pass of a step, and the roles of the copies when the step begins.
struct StepPass {
    std::size_t pass = 0;
    std::int64_t complete = 0;  ///< The number of complete steps before the pass.
    CopyRoles roles;
};

/// The error of a species in a step, and the species' new values.
struct ErrorOfStep {
    /// The root mean squares of the errors and of the values over the cells. Not finite if an error
    /// or a value is not finite.
    double error = 0, values = 0;
};

class Executor {
public:
    virtual ~Executor() = default;
    Executor() = default;
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    virtual const StepProblem& problem() const = 0;
    /// The means by which executors in several processes agree on the steps that they share; null
    /// if only this process takes the steps.
    virtual SharedSteps* shared_steps() { return nullptr; }
    /// From now on runs the passes of this problem, which must have the same grid and species as
    /// the previous one. Makes the registers that the problem needs. The problem must outlive its
    /// use.
    virtual void prepare(const StepProblem& problem) = 0;

    // Access to planes. The result of fetch(), and pointers into it, may be read until planes are
    // next written, put or exchanged. The result of take() belongs to the caller until it is put
    // back.

    virtual const std::vector<Field>& fetch(int copy) = 0;
    virtual const std::vector<Field>& fetch(RegisterId scratch) = 0;
    /// Gives a copy to the caller, who must put it back before anything else uses that copy.
    virtual std::vector<Field> take(int copy) = 0;
    /// Takes a copy back, including its halo.
    virtual void put(int copy, std::vector<Field> species) = 0;
    /// Swaps two scratch registers.
    virtual void exchange(RegisterId one, RegisterId other) = 0;
    /// Fills the halo of a copy for a moment; see StepProblem::fill_halos().
    virtual void fill_halos(int copy, SideMoment moment) = 0;

    // Taking steps. If `cancel`, which may be null, becomes true, these functions abandon their
    // work (core/parallel.h). The planes that passes write are then undefined.

    /// Runs `count` passes, from `first` to the end of a step. If `check` is true, returns whether
    /// all new values are finite, otherwise returns true.
    virtual bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
                     const std::atomic<bool>* cancel) = 0;
    /// Runs the passes of one step, from `first` on. The problem must have an error register.
    /// Returns the errors by species.
    virtual std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                                const std::atomic<bool>* cancel) = 0;
    /// Whether all values of a copy are finite.
    virtual bool is_finite(int copy) = 0;

    // The functions below choose how passes run. They change no result.

    virtual int most_threads() const = 0;
    /// Sets the number of threads that share the work.
    virtual void use_threads(int threads) = 0;
    /// The tiling that fits the machine's caches, followed by other tilings that may be faster.
    virtual std::vector<Tiling> tilings_to_try() const = 0;
    /// From now on uses this tiling, even if the problem changes.
    virtual void use_tiling(const Tiling& tiling) = 0;
    /// The largest number of passes that run together while their values are in a cache or, in a
    /// part of a grid, between two exchanges of halos.
    virtual int levels() const = 0;
    /// How steps use the caches; see Stepping.
    virtual Stepping stepping() const = 0;
};

/// Makes an executor for a problem. The first copy is `species`. There are three copies if `keeps`
/// is true, else two.
using MakeExecutor =
    std::function<std::unique_ptr<Executor>(const StepProblem& problem, std::vector<Field> species,
                                            int most_threads, bool keeps)>;

/// Makes an executor that runs on threads of this process, with planes in this process's memory.
/// Begins with `most_threads` threads, or with fewer on small grids.
std::unique_ptr<Executor> make_thread_executor(const StepProblem& problem,
                                               std::vector<Field> species, int most_threads,
                                               bool keeps);

/// Makes an executor as make_thread_executor() does, but for one part of the grid. Planes have the
/// layout of layout_of(), and all parts call the same functions in the same order. `others` must
/// outlive the executor.
std::unique_ptr<Executor> make_part_executor(const StepProblem& problem, std::vector<Field> species,
                                             int most_threads, bool keeps, Exchange& others);

/// Divides the grid into `count` parts of nearly equal size, or fewer if there are fewer rows or
/// slices. Each part has a separate thread and separate memory. One part gathers whole planes and
/// computes convolutions, constraints and filters of waves on them. Parts are at least `thickness`
/// times as thick as their halos; see levels_of_halo(). Serves to test that the result is the same
/// bit for bit with any number of parts.
MakeExecutor in_parts(int count, std::int64_t thickness = least_thickness);

}  // namespace cascade
