// Which steps a time loop takes, and how often it checks and observes them.
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

/// Called on the caller's thread with the number of complete steps, except for `first_step`. The
/// species (the vector that was given to the loop) hold that step's values, which have been found
/// finite. Returns false to end the stage there.
using Observer = std::function<bool(std::int64_t step, double t, std::span<const Field> species)>;
/// Called likewise, but returns true to end the stage.
using EndTest = Observer;
/// Called likewise; cannot influence the run.
using Onlooker = std::function<void(std::int64_t step, double t, std::span<const Field> species)>;

/// Called on the caller's thread at a complete step. A run that resumes from its arguments gets the
/// same bits. Species are as for an Observer.
using Keeper = std::function<void(std::int64_t step, double t, const TimeState& time)>;

/// The length and the passes of the next steps.
struct StepChoice {
    double step = 0;                       ///< Length of the steps.
    const StepProblem* problem = nullptr;  ///< The passes of a step,
    const StepProblem* judged = nullptr;   ///< and of a step with an estimated error, if any.
};
/// Chooses the next steps from the present values, in the caller's vector, and from the `time` so
/// far. May change any part of `time` except the clock and the controller. `rejected` says that the
/// last choice was too long.
using StepChooser = std::function<StepChoice(std::int64_t step, TimeState& time, bool rejected)>;

/// Which steps to take, and how often to check and observe them.
struct Schedule {
    std::int64_t first_step = 0;  ///< Complete steps so far (more than 0 after a resume).
    std::int64_t last_step = 0;   ///< Stop when this number is complete.
    /// Later calls will probably continue up to this step, so trials for speed may pay off.
    std::int64_t planned_step = 0;
    TimeState time = {};  ///< At `first_step`.
    /// Stop when t reaches this. The last step is shortened to end there.
    double end_time = std::numeric_limits<double>::infinity();
    /// `observe` is called at multiples of this. If it is 0 and there is an end time, `observe` is
    /// called at the first step that reaches a tenth of it, two tenths, …
    std::int64_t interval = 0;
    /// The first moment after t, or infinity: the loop also stops at the last step that begins
    /// before it and at the one after that, and observes all its stops. No step becomes shorter.
    std::function<double(double t)> next_moment = {};
    bool tenths = false;     ///< Also observe at tenths if `interval` is not 0.
    std::int64_t check = 0;  ///< `ends` is called at multiples of this; 0: never.
    EndTest ends = {};
    /// `choose` is called at multiples of this, including 0, or with a tolerance after every step
    /// with an estimated error.
    std::int64_t choose_every = 0;
    StepChooser choose = {};
    /// If the steps before `first_step` are unknown, as when a run continues with other equations,
    /// `choose` is called there, too.
    bool begins_anew = false;
    /// If above 0, errors are estimated, of all steps or of the steps that `choose` selects. A step
    /// whose error exceeds this fraction of the values is repeated with a shorter length.
    double tolerance = 0;
    double largest_step = std::numeric_limits<double>::infinity();  ///< Limit of their length,
    std::function<double(double t)> longest_step = {};  ///< and the limit for a step that begins at
                                                        ///< t.
    /// If rates jump, the step after one that ends at t begins a rounding error later.
    std::function<double(double t)> time_after = {};
    int error_order = 1;  ///< The error is proportional to this power of the step.
    /// With a tolerance: the passes of a step with an estimated error, if not all steps have one.
    const StepProblem* judged = nullptr;
    bool judges_all = false;        ///< The error of every step is estimated.
    std::int64_t check_every = 64;  ///< Steps between two checks for non-finite values.
    Onlooker onlooker = {};         ///< Sees the species at each of those checks.
    /// At each check, a copy of all species is stored to find the step that spoils a value, unless
    /// it takes more than this number of bytes, memory that the user needs for cells.
    std::int64_t most_kept_bytes = std::int64_t{256} << 20;
    /// Called before each batch of steps (about 20 ms): must the state after it be saved? If so,
    /// that state is also checked for non-finite values, and `keep` is called. Results do not
    /// depend on it.
    std::function<bool()> keep_is_due = {};
    Keeper keep = {};
    int threads = 1;
    MakeExecutor executor = make_thread_executor;  ///< What takes the steps.
    /// The tiling; none: chosen by size and by time. No result depends on it.
    std::optional<Tiling> tiling = {};
    /// Knows the fastest tiling of earlier runs and receives this run's; may be null.
    TilingMemory* tilings = nullptr;
};

/// The number of tenths of the end time that have passed; 0 without an end time.
double tenths_reached(double t, double end_time);

/// Does Schedule::most_kept_bytes allow a copy of such species?
bool keeps_copy(const Schedule& schedule, std::size_t species, const Grid& grid,
                Precision precision);

}  // namespace cascade
