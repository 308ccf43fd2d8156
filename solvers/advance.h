// The time loop of one stage: takes a step again and again.
//
// Simultaneous update: a step reads the old planes and writes new ones, then the two change places.
// Between steps the halo of every species that is read at neighbours is filled, but for linked
// cells. Rows are shared by a team of threads; results do not depend on how many.
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

/// The first value that was not finite.
struct NotFinite {
    std::size_t species = 0;
    std::int64_t column = 0, row = 0;
    std::int64_t step = 0;  ///< It appeared in this step (the first step is 1).
                            ///< Schedule::first_step where a start value was so already.
    /// The last step at which all values are known to have been finite: the one before, or, without
    /// a kept copy, that of the look before. `step` where a start value was not.
    std::int64_t last_finite = 0;

    bool at_start() const { return last_finite == step; }
    bool is_exact() const { return last_finite + 1 == step; }
};

/// An adaptive step that has become too short to get anywhere.
struct StepTooShort {
    double t = 0, step = 0;
    std::size_t species = 0;           ///< Where the error is largest,
    std::int64_t column = 0, row = 0;  ///< and the cell.
};

struct StageOutcome {
    std::int64_t steps = 0;  ///< Complete steps when the loop ended.
    double t = 0;            ///< The time then.
    TimeState time;          ///< To go on from there.
    bool cancelled = false;
    bool ended = false;  ///< By its end time or by `ends`.
    int threads = 1;     ///< In use when the loop ended.
    std::optional<StepTooShort> too_short;
    std::optional<NotFinite> not_finite;
    /// Only with `not_finite` and a kept copy: the species at the last look before, up to
    /// `check_every` steps earlier, when growth was slight still. A good state to estimate
    /// stability at.
    std::vector<Field> last_checked;
};

/// Takes the steps of a stage and stays ready to go on: its threads, its copies of the species and
/// what it has found out about speed live as long as it does.
///
/// Needs memory for three copies of all species, for two where none is kept.
class TimeLoop {
public:
    /// `problem` has the passes of the first steps. It and `species`, start values in, last
    /// complete step out, must outlive the loop, and only the loop may change them. Addresses of
    /// the values of `species` change. `progress` carries the stage's name and numbers.
    TimeLoop(const StepProblem& problem, Schedule schedule, std::vector<Field>& species,
             Progress progress);
    ~TimeLoop();
    TimeLoop(const TimeLoop&) = delete;
    TimeLoop& operator=(const TimeLoop&) = delete;

    /// Goes on until `last_step` is complete, observed at multiples of `interval`: the two
    /// numbers replace the schedule's. When a look finds a value that is not finite, the steps
    /// since the last look, at most `check_every`, are replayed from a kept copy to name step and
    /// cell; then the species hold the last step at which all were finite. Where no copy is kept
    /// the look itself names a cell, and they stay spoiled. Reports through `control`: at once,
    /// about ten times a second, and with `stage_done` at the end for whatever reason. If
    /// `control.cancel` is set it ends at the next complete step (batches of steps between two
    /// looks at it take about 20 ms). May be called again unless a value was spoiled or steps
    /// became too short.
    StageOutcome advance(std::int64_t last_step, std::int64_t interval, RunControl& control,
                         const Observer& observe);

    /// How the last steps went through memory.
    Stepping stepping() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> self_;
};

/// Takes the steps of a schedule, with a TimeLoop of their own.
StageOutcome advance(const StepProblem& problem, const Schedule& schedule,
                     std::vector<Field>& species, RunControl& control, Progress progress,
                     const Observer& observe);

}  // namespace cascade
