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
#include "solvers/stage_clock.h"
#include "solvers/step_problem.h"
#include "solvers/stepping.h"
#include "solvers/tiling_memory.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Called on the caller's thread with the number of complete steps, not for `first_step`; the
/// species (the same vector that was given to advance()) are as that step left them, and have been
/// found finite. Returns false to end the stage there.
using Observer = std::function<bool(std::int64_t step, double t, std::span<const Field> species)>;
/// The same, but returns true where the stage is to end.
using EndTest = Observer;
/// Is shown the same, and has no say in anything.
using Onlooker = std::function<void(std::int64_t step, double t, std::span<const Field> species)>;

/// Called on the caller's thread at a complete step, after which a run can go on from what it is
/// given with the same bits. The species are as for an Observer.
using Keeper = std::function<void(std::int64_t step, double t, const TimeState& time)>;

/// How the next steps are taken.
struct StepChoice {
    double step = 0;                       ///< Their length.
    const StepProblem* problem = nullptr;  ///< Their sweeps,
    const StepProblem* judged =
        nullptr;  ///< and those of a step whose error is estimated, if any is.
};
/// Chooses from the present values, which the caller holds meanwhile, and from the `time` so far.
/// It may change whatever of `time` is not the clock's or the controller's. `rejected`: the last
/// choice was too long a step.
using StepChooser = std::function<StepChoice(std::int64_t step, TimeState& time, bool rejected)>;

/// Which steps to take and how closely to watch them.
struct Schedule {
    std::int64_t first_step = 0;  ///< Complete steps so far (more than 0 after a resume).
    std::int64_t last_step = 0;   ///< Stop when so many are complete.
    TimeState time = {};          ///< At `first_step`.
    /// Stop when t is so large; the last step is shortened to end there.
    double end_time = std::numeric_limits<double>::infinity();
    /// `observe` is called at multiples of this. Where it is 0 and there is an end time, at the
    /// first step that reaches a tenth of it, two tenths, …
    std::int64_t interval = 0;
    bool tenths = false;     ///< Then also where `interval` is not 0.
    std::int64_t check = 0;  ///< `ends` is asked at multiples of this; 0 for never.
    EndTest ends = {};
    /// `choose` is asked at multiples of this, 0 included; with a tolerance after every step whose
    /// error is estimated.
    std::int64_t choose_every = 0;
    StepChooser choose = {};
    /// Above 0: the error of steps is estimated, of all of them or, where `choose` says so, of
    /// some; and they are taken again, shorter, where it is larger than this part of the values.
    double tolerance = 0;
    double largest_step = std::numeric_limits<double>::infinity();  ///< Of such steps,
    std::function<double(double t)> longest_step = {};  ///< and of one that begins at t.
    int error_order = 1;  ///< That error is proportional to step^this.
    /// With a tolerance: the sweeps of a step whose error is estimated, where it is not that of all
    /// steps.
    const StepProblem* judged = nullptr;
    bool judges_all = false;        ///< It is.
    std::int64_t check_every = 64;  ///< Steps between two looks for values that are not finite.
    Onlooker onlooker = {};         ///< Sees the species at each of those looks.
    /// A copy of all species of at most so many bytes is kept from look to look, to find out in
    /// which step a value was spoiled. Larger ones would cost memory that their user needs for his
    /// cells.
    std::int64_t most_kept_bytes = std::int64_t{256} << 20;
    /// Asked before each batch of steps (some 20 ms): is the state after it to be kept? Then it is
    /// looked at for values that are not finite, too, and `keep` is called. No result depends on
    /// it.
    std::function<bool()> keep_is_due = {};
    Keeper keep = {};
    int threads = 1;
    /// How steps go through memory; none: as fits, or as turns out to be faster. No result depends
    /// on it.
    std::optional<Tiling> tiling = {};
    /// Knows what earlier runs found to be faster, and is told what this one finds; nullptr: nobody
    /// does.
    TilingMemory* tilings = nullptr;
};

/// How many tenths of the way to the end time are behind; 0 where there is none.
double tenths_reached(double t, double end_time);

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
    Stepping stepping;       ///< How the last steps went through memory.
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

/// Is a copy kept of so many species, as Schedule::most_kept_bytes has it?
bool keeps_copy(const Schedule& schedule, std::size_t species, const Grid& grid,
                Precision precision);

/// Advances `species` (start values in, last complete step out). When a look finds a value that is
/// not finite, the steps since the last look, at most `check_every`, are replayed from a kept copy
/// to name step and cell; then `species` hold the last step at which all were finite. Where no copy
/// is kept the look itself names a cell, and `species` stay spoiled. `progress` carries the stage's
/// name and numbers; the loop fills in the rest and reports through `control`: at once, about ten
/// times a second, and with `stage_done` when the loop ends for whatever reason. If
/// `control.cancel` is set it ends at the next complete step (batches of steps between two looks at
/// it take about 20 ms).
///
/// Needs memory for three copies of all species, for two where none is kept. Addresses of the
/// fields' values change.
StageOutcome advance(const StepProblem& problem, const Schedule& schedule,
                     std::vector<Field>& species, RunControl& control, Progress progress,
                     const Observer& observe);

}  // namespace cascade
