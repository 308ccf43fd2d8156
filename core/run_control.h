// What a run tells its caller while it goes on, and how the caller stops it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace cascade {

/// How far a stage is. Sent now and then (some ten times a second), and at a stage's end.
struct Progress {
    std::string doing;     ///< What goes on where no stage runs; then nothing else means anything.
    std::string stage;     ///< The stage's name.
    std::string note;      ///< What is to be said after it; mostly nothing.
    int stage_number = 1;  ///< From 1.
    int stage_count = 1;
    std::int64_t step = 0;        ///< Complete steps of this stage.
    std::int64_t steps = 0;       ///< Steps this stage will take.
    double t = 0;                 ///< The stage's time, where its end is given by time,
    double duration = 0;          ///< and that end; 0 where it is given by steps.
    double steps_per_second = 0;  ///< Recent rate; 0 while unknown.
    double seconds_left = -1;     ///< Of this stage at that rate; negative while unknown.
    bool stage_done = false;
    bool condition_met = false;  ///< The stage's own condition, its `until`, has ended it:
    std::string when_met;        ///< what to say then, as "settled".
};

/// Shared between a run and whoever watches it. `cancel` may be set from a signal handler or from
/// another thread: the run ends at the next complete step.
struct RunControl {
    std::atomic<bool> cancel{false};
    std::function<void(const Progress&)> report;
    /// Remarks that do not stop the run (the chequerboard warning, a kernel that is interpreted).
    std::function<void(const std::string& message)> warn;
    /// What is good to know, and nothing is wrong with.
    std::function<void(const std::string& message)> note;
};

}  // namespace cascade
