// The short time that a program has after SIGTERM, SIGHUP or --limit-time. It is short because a
// system that shuts down soon kills the processes that are left.
#pragma once

#include "core/run_control.h"

#include <memory>

namespace cascade {

/// While it exists, and once begin_last_moments() is called, `hurry` is set after half of a time,
/// and at its end the program ends where `may_end` is true. The time is 2 s of processor time or,
/// if the limit of time is reached, a tenth of `limit_seconds` if that is more. `hurry` is also set
/// after 5 s of the clock, in which another program may have computed. Only one may exist at a
/// time. It uses system timers, since creating a thread may be denied.
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

/// For signal handlers. The program will end with `status`. Does nothing if no LastMoments exists,
/// or if they have begun.
void begin_last_moments(int status) noexcept;

}  // namespace cascade
