// The time loop of one stage, which takes step after step.
//
// The update is simultaneous: a step reads the old planes and writes new ones, then old and new
// planes are swapped. Between steps the halo is filled for every species that is read at neighbours
// (linked cells have no halo). A team of threads shares the rows. Results do not depend on the
// number of threads.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/result.h"
#include "core/run_control.h"
#include "solvers/schedule.h"
#include "solvers/stage_clock.h"
#include "solvers/step_problem.h"
#include "solvers/stepping.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// The first non-finite value.
struct NotFinite {
    std::size_t species = 0;
    std::int64_t column = 0, row = 0;
    /// The step in which the value appeared, counted from 1, or Schedule::first_step for a starting
    /// value.
    std::int64_t step = 0;
    /// The last step whose values are known to be finite: the step before `step` or, if no copy of
    /// the values was stored, the step of the last check. If a starting value is not finite, this
    /// equals `step`.
    std::int64_t last_finite = 0;

    bool at_start() const { return last_finite == step; }
    bool is_exact() const { return last_finite + 1 == step; }
};

/// An adaptive step that has become too short to make progress.
struct StepTooShort {
    double t = 0, step = 0;
    std::size_t species = 0;           ///< The species in which the error is largest.
    std::int64_t column = 0, row = 0;  ///< The cell in which the error is largest.
};

struct StageOutcome {
    std::int64_t steps = 0;  ///< Number of complete steps when the loop ended.
    double t = 0;            ///< The stage's time at the end of the loop.
    TimeState time;          ///< The state from which steps continue.
    bool cancelled = false;
    bool ended = false;  ///< Whether the stage ended by its end time or by `ends`.
    int threads = 1;     ///< The number of threads in use at the end.
    std::optional<StepTooShort> too_short;
    std::optional<NotFinite> not_finite;
    /// Set only if `not_finite` is set and a copy was stored: the species at the last check that
    /// found all values finite. This check was at most `check_every` steps before the failure, when
    /// growth was still slight, so these values give the best estimate of stability.
    std::vector<Field> last_checked;
};

/// Takes the steps of a stage in one or several calls. Between calls it keeps its threads, its
/// copies of the species and its measurements of speed.
///
/// Needs memory for three copies of all species, or for two if the schedule stores no copy at
/// checks.
class TimeLoop {
public:
    /// `problem` holds the passes of the first steps. `species` holds the starting values, and
    /// afterwards the values of the last complete step. Both must outlive the loop, and only the
    /// loop may change them meanwhile. Values in `species` may move to other addresses. `progress`
    /// carries the stage's name and number.
    TimeLoop(const StepProblem& problem, Schedule schedule, std::vector<Field>& species,
             Progress progress);
    ~TimeLoop();
    TimeLoop(const TimeLoop&) = delete;
    TimeLoop& operator=(const TimeLoop&) = delete;

    /// Continues until `last_step` is complete and observes at multiples of `interval`. These two
    /// arguments replace the schedule's members of the same names.
    ///
    /// If a check finds a non-finite value, the steps since the last check (at most `check_every`)
    /// are replayed from the stored copy to find the step and the cell. Then `species` holds the
    /// last step at which all values were finite. Without a stored copy the check itself names a
    /// cell, and `species` has the spoiled values.
    ///
    /// Reports through `control` at the start, about ten times a second, and at the end of every
    /// call, where `stage_done` is set. The last step of a call is checked unless
    /// `control.checks_later`. If `control.cancel` is set, the loop ends at the next complete step.
    /// The loop reads this flag after each batch of steps, about every 20 ms. May be called again
    /// unless a value was spoiled or steps became too short.
    StageOutcome advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                         const Observer& observe);

    /// Stepper::curve() of the last step. An observer may call this.
    std::vector<Field> curve() const;

    /// How the last steps used the caches; see Stepping.
    Stepping stepping() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> self_;
};

/// Takes the steps of a schedule with a temporary TimeLoop.
StageOutcome advance(const StepProblem& problem, const Schedule& schedule,
                     std::vector<Field>& species, RunControl& control, Progress progress,
                     const Observer& observe);

}  // namespace cascade
