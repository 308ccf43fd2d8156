// A run's reports to its caller, and the caller's way to stop it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace cascade {

/// The progress of a stage. Sent about ten times a second and once more when the stage ends.
struct Progress {
    /// Names the current activity between stages. Its progress is `step` of `steps` if `steps` is
    /// above 0.
    std::string doing;
    std::string stage;     ///< The stage's name.
    std::string note;      ///< Words to print after the stage's name; usually empty.
    int stage_number = 1;  ///< Counted from 1.
    int stage_count = 1;
    std::int64_t step = 0;   ///< Number of completed steps of this stage.
    std::int64_t steps = 0;  ///< Number of steps that this stage will take.
    double t = 0;            ///< The stage's time, if the stage ends at a given time.
    /// The time at which the stage ends; 0 if it ends after a number of steps.
    double duration = 0;
    double steps_per_second = 0;  ///< Recent rate; 0 while unknown.
    double seconds_left = -1;     ///< Estimate for this stage; negative while unknown.
    bool stage_done = false;
    bool condition_met = false;  ///< Whether the stage ended by its own condition, `until`.
    std::string when_met;  ///< The word to print if `condition_met` is true, such as "settled".
};

/// A flag that is never set, for long operations that cannot be cancelled.
inline const std::atomic<bool> never_cancelled{false};

/// Shared between a run and its observer. A signal handler or another thread may set `cancel`. The
/// run then ends after a complete step, or abandons a step that takes long.
struct RunControl {
    std::atomic<bool> cancel{false};
    /// Set some time after `cancel` if the program must end soon: outputs that take long to write
    /// are then left out.
    std::atomic<bool> hurry{false};
    /// Whether ending the program now would lose only outputs that take long to write. False from
    /// the first step until the run is saved.
    std::atomic<bool> may_end{true};
    /// Set when many short calls together take the steps of one stage. A call may then return
    /// before it checks for non-finite values, and a later call checks, at most 64 steps after such
    /// values appear. Doubts about the result are reported at the end of the stage, and faster ways
    /// to step are tried as if one call took all steps.
    bool checks_later = false;
    std::function<void(const Progress&)> report;
    /// Called with each warning that does not stop the run, for example that a kernel is
    /// interpreted instead of compiled.
    std::function<void(const std::string& message)> warn;
    /// Called with information for the user that is not a problem.
    std::function<void(const std::string& message)> note;
};

}  // namespace cascade
