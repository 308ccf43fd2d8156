// What a run reports to its caller, and how the caller stops it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace cascade {

/// The progress of a stage. Sent some ten times a second and at the end of a stage.
struct Progress {
    std::string doing;     ///< The activity while no stage runs: `step` of `steps`, if above 0.
    std::string stage;     ///< The stage's name.
    std::string note;      ///< A remark to print after it; usually empty.
    int stage_number = 1;  ///< From 1.
    int stage_count = 1;
    std::int64_t step = 0;        ///< Completed steps of this stage.
    std::int64_t steps = 0;       ///< Steps this stage will take.
    double t = 0;                 ///< The stage's time if its end is given by time,
    double duration = 0;          ///< and that end; 0 if the end is given by steps.
    double steps_per_second = 0;  ///< Recent rate; 0 while unknown.
    double seconds_left = -1;     ///< Of this stage at that rate; negative while unknown.
    bool stage_done = false;
    bool condition_met = false;  ///< The stage was ended by its own condition, `until`;
    std::string when_met;        ///< then the word to print, such as "settled".
};

/// For what takes long and is not to be cancelled.
inline const std::atomic<bool> never_cancelled{false};

/// Shared between a run and its observer. `cancel` may be set from a signal handler or from another
/// thread; the run then ends after a complete step; one that takes long is left undone.
struct RunControl {
    std::atomic<bool> cancel{false};
    /// The steps of a stage are taken by many calls: one may leave without looking for values that
    /// are not finite, which a later call finds, at most 64 steps after they appeared; doubts wait
    /// for the stage's end; what makes steps faster is tried as if one call took them all.
    bool checks_later = false;
    std::function<void(const Progress&)> report;
    /// Warnings that do not stop the run, such as an interpreted kernel.
    std::function<void(const std::string& message)> warn;
    /// Information; nothing is wrong.
    std::function<void(const std::string& message)> note;
};

}  // namespace cascade
