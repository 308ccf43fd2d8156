// Which steps a time loop takes, and how closely it watches them.
#pragma once

#include "core/plane.h"
#include "solvers/stage_clock.h"
#include "solvers/step_problem.h"
#include "solvers/tiling_memory.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>

namespace cascade {

/// Called on the caller's thread with the number of complete steps, not for `first_step`; the
/// species (the same vector that was given to the loop) are as that step left them, and have been
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
    std::int64_t last_step = 0;   ///< Stop when this number is complete.
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
    /// Remembers which tiling was fastest in earlier runs, and receives the result of this one; may
    /// be null.
    TilingMemory* tilings = nullptr;
};

/// The number of tenths of the time to the end that have passed; 0 if there is no end time.
double tenths_reached(double t, double end_time);

/// Is a copy kept of so many species, as Schedule::most_kept_bytes has it?
bool keeps_copy(const Schedule& schedule, std::size_t species, const Grid& grid,
                Precision precision);

}  // namespace cascade
