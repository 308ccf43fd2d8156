// The steps that a time loop takes, and how often it checks and observes them.
#pragma once

#include "core/plane.h"
#include "solvers/executor.h"
#include "solvers/stage_clock.h"
#include "solvers/step_problem.h"
#include "solvers/tiling_memory.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>

namespace cascade {

/// Called on the thread that called the loop, with the number of complete steps, but not at
/// `first_step`. The vector of species that was given to the loop holds the values after these
/// steps, which have been checked to be finite. Returns false to end the stage.
using Observer = std::function<bool(std::int64_t step, double t, std::span<const Field> species)>;
/// Called like an Observer, but returns true to end the stage.
using EndTest = Observer;
/// Called like an Observer, but cannot influence the run.
using Onlooker = std::function<void(std::int64_t step, double t, std::span<const Field> species)>;

/// Called on the thread that called the loop, after a complete step. A run that resumes with these
/// arguments and the present species continues with the same bits.
using Keeper = std::function<void(std::int64_t step, double t, const TimeState& time)>;

/// The length and the passes of the next steps.
struct StepChoice {
    double step = 0;                       ///< Length of the steps.
    const StepProblem* problem = nullptr;  ///< The passes of a step without an estimated error.
    /// The passes of a step with an estimated error; null if there are no such steps.
    const StepProblem* judged = nullptr;
};
/// Chooses the next steps from the present values, which are in the vector of species given to the
/// loop, and from the `time` so far. May change any part of `time` except the clock and the
/// controller. If `rejected` is true, the step chosen last was too long.
using StepChooser = std::function<StepChoice(std::int64_t step, TimeState& time, bool rejected)>;

/// The steps to take, and how often to check and observe them.
struct Schedule {
    std::int64_t first_step = 0;  ///< Number of complete steps so far (more than 0 after a resume).
    std::int64_t last_step = 0;   ///< The loop stops when this number of steps is complete.
    /// The step up to which later calls will probably continue. If that step is far ahead, longer
    /// trials of threads and tilings are worth their cost.
    std::int64_t planned_step = 0;
    TimeState time = {};  ///< The time at `first_step`.
    /// The loop stops when t reaches this time. The last step is shortened to end there.
    double end_time = std::numeric_limits<double>::infinity();
    /// If above 0, a step ends at each multiple of this time. A step that would pass a multiple is
    /// shortened.
    double every = 0;
    /// The length of every step that is neither shortened nor chosen by `choose`.
    double fixed_step = 0;
    /// The interval of observations: `observe` is called at multiples of this number of steps. If
    /// the interval is 0, `observe` is called at the first step that reaches each further mark.
    /// Marks are the multiples of `every` or, if `every` is 0, tenths of the end time.
    std::int64_t interval = 0;
    /// Returns the first moment to observe after t, or infinity. The loop observes at the last
    /// complete step before that moment and at the step after it. No step is shortened to end at
    /// the moment.
    std::function<double(double t)> next_moment = {};
    bool marks = false;  ///< Whether `observe` is called at marks, too, if `interval` is not 0.
    /// `ends` is called at multiples of this number of steps; never if it is 0.
    std::int64_t check = 0;
    EndTest ends = {};
    /// `choose` is called at multiples of this number of steps, including 0. If there is a
    /// tolerance, `choose` is called only after steps with an estimated error, and after each of
    /// them.
    std::int64_t choose_every = 0;
    StepChooser choose = {};
    /// Set if the steps before `first_step` are unknown, for example if a run continues with other
    /// equations. `choose` is then called at `first_step`, too.
    bool begins_anew = false;
    /// If above 0, errors are estimated: for all steps, or for the steps that `choose` selects. A
    /// step whose error exceeds this fraction of the values is repeated with a shorter length.
    double tolerance = 0;
    /// The largest length of any step.
    double largest_step = std::numeric_limits<double>::infinity();
    /// The largest length of a step that begins at t.
    std::function<double(double t)> longest_step = {};
    /// If rates jump at certain times: maps the time t at which a step ends to the time at which
    /// the next step begins, which is later by a rounding error.
    std::function<double(double t)> time_after = {};
    int error_order = 1;  ///< The error is proportional to the step to this power.
    /// The passes of a step with an estimated error. Set only if there is a tolerance and not every
    /// step has an estimated error.
    const StepProblem* judged = nullptr;
    bool judges_all = false;        ///< Whether the error of every step is estimated.
    std::int64_t check_every = 64;  ///< Number of steps between two checks for non-finite values.
    Onlooker onlooker = {};         ///< Called at each check for non-finite values.
    /// The largest size of a copy of all species, in bytes. Such a copy is stored at each check, so
    /// that the step that spoils a value can be found. If the copy would be larger, it is not
    /// stored, because the user needs that memory for cells.
    std::int64_t most_kept_bytes = std::int64_t{256} << 20;
    /// Called before each batch of steps (about 20 ms). Returns whether the state after the batch
    /// must be saved. If so, that state is also checked for non-finite values, and `keep` is
    /// called. The answer does not influence the run's results.
    std::function<bool()> keep_is_due = {};
    Keeper keep = {};
    int threads = 1;
    MakeExecutor executor = make_thread_executor;  ///< Makes the executor of the steps.
    /// The tiling to use. If it is nullopt, the sizes of caches and measured times decide. No
    /// result depends on the tiling.
    std::optional<Tiling> tiling = {};
    /// Gives the fastest tiling of earlier runs and receives the fastest tiling of this run; may be
    /// null.
    TilingMemory* tilings = nullptr;
};

/// The number of marks up to time t, inclusive. Marks are the multiples of `every` or, if `every`
/// is 0, tenths of the end time. 0 if there is no end time either.
double marks_reached(double t, double end_time, double every);
/// The next multiple of `every` after t; infinity if `every` is 0.
double next_mark(double t, double every);

/// Whether a copy of all species, with this grid and precision, is at most as large as
/// Schedule::most_kept_bytes.
bool keeps_copy(const Schedule& schedule, std::size_t species, const Grid& grid,
                Precision precision);

}  // namespace cascade
