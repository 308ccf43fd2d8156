// The time loop of one stage, which takes step after step.
//
// The update is simultaneous: a step reads the old planes and writes new ones, then the two are
// swapped. Between steps the halo is filled for every species that is read at neighbours (linked
// cells have no halo). A team of threads shares the rows. Results do not depend on the number of
// threads.
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
    std::int64_t step = 0;  ///< The step in which it appeared, counted from 1, or
                            ///< Schedule::first_step for a starting value.
    /// The last step known to be finite: the previous one or, without a stored copy, the step of
    /// the last check. Equal to `step` for a starting value.
    std::int64_t last_finite = 0;

    bool at_start() const { return last_finite == step; }
    bool is_exact() const { return last_finite + 1 == step; }
};

/// An adaptive step that has become too short to make progress.
struct StepTooShort {
    double t = 0, step = 0;
    std::size_t species = 0;           ///< The species and the cell
    std::int64_t column = 0, row = 0;  ///< in which the error is largest.
};

struct StageOutcome {
    std::int64_t steps = 0;  ///< Complete steps when the loop ended.
    double t = 0;            ///< The stage's time at that moment.
    TimeState time;          ///< The state from which steps continue.
    bool cancelled = false;
    bool ended = false;  ///< Stopped by its end time or by `ends`.
    int threads = 1;     ///< The number in use at the end.
    std::optional<StepTooShort> too_short;
    std::optional<NotFinite> not_finite;
    /// Only with `not_finite` and a stored copy: the species at the previous check, up to
    /// `check_every` steps earlier, when growth was still slight. This state gives the best
    /// estimate of stability.
    std::vector<Field> last_checked;
};

/// Takes the steps of a stage and stays ready to continue: its threads, its copies of the species
/// and its measurements of speed survive between calls.
///
/// Needs memory for three copies of all species, or for two if no copy is stored at checks.
class TimeLoop {
public:
    /// `problem` holds the passes of the first steps. `species` holds the starting values, and
    /// afterwards the last complete step. Both must outlive the loop, and only the loop may change
    /// them meanwhile. The addresses of the values in `species` change. `progress` carries the
    /// stage's name and numbers.
    TimeLoop(const StepProblem& problem, Schedule schedule, std::vector<Field>& species,
             Progress progress);
    ~TimeLoop();
    TimeLoop(const TimeLoop&) = delete;
    TimeLoop& operator=(const TimeLoop&) = delete;

    /// Continues until `last_step` is complete and observes at multiples of `interval`, instead of
    /// the schedule's numbers. If a check finds a non-finite value, the steps since the last check
    /// (at most `check_every`) are replayed from the stored copy to find the step and the cell, and
    /// `species` then holds the last step at which all values were finite. Without a stored copy
    /// the check itself names a cell, and `species` has the spoiled values. Reports through
    /// `control`: at once, about ten times a second, and with `stage_done` at the end, however it
    /// ends. The last step of a call is checked unless `control.checks_later`. If `control.cancel`
    /// is set, the loop ends at the next complete step. It reads the flag after each batch of
    /// steps, about every 20 ms. May be called again unless a value was spoiled or steps became too
    /// short.
    StageOutcome advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                         const Observer& observe);

    /// How the last steps went through memory.
    Stepping stepping() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> self_;
};

/// Takes the steps of a schedule with a TimeLoop made for the purpose.
StageOutcome advance(const StepProblem& problem, const Schedule& schedule,
                     std::vector<Field>& species, RunControl& control, Progress progress,
                     const Observer& observe);

}  // namespace cascade
