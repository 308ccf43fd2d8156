// What takes the steps of a stage: it owns the planes that steps read and write, wherever they lie,
// and runs the passes of a problem over them.
//
// The time loop decides how many steps are taken, and which of them count. It knows planes by name:
// *copies* of all species, which steps go from one to the next, and scratch registers. Values leave
// an executor by fetch() and take(), and come back by put(); halos, aggregates, filters of waves,
// convolutions, constraints, norms and checks are computed where the planes are.
#pragma once

#include "core/plane.h"
#include "solvers/exchange.h"
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
/// memory for it, is the kept one: keep() declares the current copy the kept one without moving a
/// byte, and steps go on between the other two, so that back() can return to it.
struct CopyRoles {
    static constexpr int none = -1;
    int kept = 0;  ///< `none` if there are two copies.
    int current = 0;
    int last = 1;  ///< The copy that was current before; it is likely to be in the cache.

    /// The copy that the next step writes: neither kept nor current.
    int target() const { return kept == none || kept == current ? last : 3 - kept - current; }
    /// Called when a step is complete.
    void go_on() { last = std::exchange(current, target()); }
    /// Is there a kept copy? Without one keep() does nothing, and back() must not be called.
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
    std::int64_t complete = 0;  ///< Complete steps before it.
    CopyRoles roles;
};

/// The error of a species in a step, and its new values.
struct ErrorOfStep {
    double error = 0, values = 0;  ///< Root mean squares over the cells; not finite if one is not.
};

class Executor {
public:
    virtual ~Executor() = default;
    Executor() = default;
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    virtual const StepProblem& problem() const = 0;
    /// From now on runs the passes of this problem, which is over the same grid and species, and
    /// makes the registers that it needs. The problem must outlive its use.
    virtual void prepare(const StepProblem& problem) = 0;

    // Planes. What fetch() returns, and pointers into it, may be read until planes are next
    // written, put or exchanged. What take() returns belongs to the caller until it is put.

    virtual const std::vector<Field>& fetch(int copy) = 0;
    virtual const std::vector<Field>& fetch(RegisterId scratch) = 0;
    /// Gives a copy away; it must be put before anything else uses that copy.
    virtual std::vector<Field> take(int copy) = 0;
    /// Takes a copy back, its halo included.
    virtual void put(int copy, std::vector<Field> species) = 0;
    /// Swaps two scratch registers.
    virtual void exchange(RegisterId one, RegisterId other) = 0;
    /// Fills the halo of a copy for a moment; see StepProblem::fill_halos().
    virtual void fill_halos(int copy, SideMoment moment) = 0;

    // Steps. If `cancel`, which may be null, becomes true, they abandon their work
    // (core/parallel.h); what passes write is then unknown.

    /// Runs `count` passes from `first` on, which end with a step. With `check`, returns whether
    /// all new values are finite; without it, true.
    virtual bool run(const StageClock& clock, StepPass first, std::size_t count, bool check,
                     const std::atomic<bool>* cancel) = 0;
    /// Runs the passes of one step from `first` on, of a problem with an error register. Returns
    /// the errors by species.
    virtual std::vector<ErrorOfStep> run_judged(const StageClock& clock, StepPass first,
                                                const std::atomic<bool>* cancel) = 0;
    /// Are all values of a copy finite?
    virtual bool is_finite(int copy) = 0;

    // Ways to run, which no result depends on.

    virtual int most_threads() const = 0;
    /// The number of threads that share the work.
    virtual void use_threads(int threads) = 0;
    /// The tiling that fits the machine's caches, and others that may be faster.
    virtual std::vector<Tiling> tilings_to_try() const = 0;
    /// From now on uses this tiling, even if the problem changes.
    virtual void use_tiling(const Tiling& tiling) = 0;
    /// The number of passes of steps for each pass through memory, as far as the passes allow.
    virtual int levels() const = 0;
    /// How steps go through memory.
    virtual Stepping stepping() const = 0;
};

/// Makes an executor for a problem. The first copy is `species`; there are three copies if `keeps`,
/// else two.
using MakeExecutor =
    std::function<std::unique_ptr<Executor>(const StepProblem& problem, std::vector<Field> species,
                                            int most_threads, bool keeps)>;

/// Threads of this process over planes in its memory. All threads are in use at first, but no more
/// than the grid is worth.
std::unique_ptr<Executor> make_thread_executor(const StepProblem& problem,
                                               std::vector<Field> species, int most_threads,
                                               bool keeps);

/// The same for one part of the grid. Planes have the layout of layout_of(), and all parts call the
/// same functions in the same order. `others` must outlive it.
std::unique_ptr<Executor> make_part_executor(const StepProblem& problem, std::vector<Field> species,
                                             int most_threads, bool keeps, Exchange& others);

/// The grid in `count` parts of nearly equal size, or fewer if it has fewer rows or slices, each in
/// a thread and in memory of its own. Convolutions, constraints and filters of waves are computed
/// by one of them on planes that it gathers. Shows that parts change no bit.
MakeExecutor in_parts(int count);

}  // namespace cascade
