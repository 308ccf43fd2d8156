// The short time that a program has to end after SIGTERM, SIGHUP or --limit-time. A system that
// shuts down kills all processes after such a time.
#pragma once

#include "core/run_control.h"

#include <memory>

namespace cascade {

/// As long as this object exists, begin_last_moments() starts a short time. At half of this time
/// `hurry` is set. At its end the program ends if `may_end` is true. The time is 2 s of processor
/// time. After --limit-time, it is a tenth of `limit_seconds` if that is longer than 2 s. `hurry`
/// is also set after 5 s of real time, because other programs may have used the processor. Only one
/// such object may exist at a time. Uses system timers, because creating a thread may be forbidden.
class LastMoments {
public:
    LastMoments(double limit_seconds, std::atomic<bool>& hurry, const std::atomic<bool>& may_end);
    LastMoments(RunControl& control, double limit_seconds)
        : LastMoments(limit_seconds, control.hurry, control.may_end) {}
    ~LastMoments();
    LastMoments(const LastMoments&) = delete;
    LastMoments& operator=(const LastMoments&) = delete;

private:
    struct Timers;
    std::unique_ptr<Timers> timers_;
};

/// Begins the last moments, after which the program ends with `status`. May be called by signal
/// handlers. Does nothing if no LastMoments exists, or if the last moments have already begun.
void begin_last_moments(int status) noexcept;

}  // namespace cascade
