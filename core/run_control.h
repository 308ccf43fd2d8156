// A run's reports to its caller, and the caller's way to stop it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace cascade {

/// The progress of a stage, sent about ten times a second and at the stage's end.
struct Progress {
    std::string doing;     ///< The activity between stages: `step` of `steps`, if above 0.
    std::string stage;     ///< The stage's name.
    std::string note;      ///< A remark to print after it; usually empty.
    int stage_number = 1;  ///< Counted from 1.
    int stage_count = 1;
    std::int64_t step = 0;        ///< Completed steps of this stage.
    std::int64_t steps = 0;       ///< Steps this stage will take.
    double t = 0;                 ///< The stage's time if it ends at a time,
    double duration = 0;          ///< and that end; 0 if it ends after some steps.
    double steps_per_second = 0;  ///< Recent rate; 0 while unknown.
    double seconds_left = -1;     ///< Estimate for this stage; negative while unknown.
    bool stage_done = false;
    bool condition_met = false;  ///< The stage ended by its own condition, `until`;
    std::string when_met;        ///< then the word to print, such as "settled".
};

/// For long operations that cannot be cancelled.
inline const std::atomic<bool> never_cancelled{false};

/// Shared between a run and its observer. A signal handler or another thread may set `cancel`. The
/// run then ends after a complete step, or abandons a step that takes long.
struct RunControl {
    std::atomic<bool> cancel{false};
    /// Set when many calls take a stage's steps together. A call may then return without a check
    /// for non-finite values, which a later call makes at most 64 steps after they appear. Doubts
    /// wait for the stage's end, and faster ways to step are tried as if one call took all steps.
    bool checks_later = false;
    std::function<void(const Progress&)> report;
    /// Warnings that do not stop the run, such as an interpreted kernel.
    std::function<void(const std::string& message)> warn;
    /// Information, not a problem.
    std::function<void(const std::string& message)> note;
};

}  // namespace cascade
