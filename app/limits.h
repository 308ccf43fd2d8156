// --limit-time and --limit-memory.
#pragma once

#include <atomic>
#include <csignal>
#include <cstdint>

namespace cascade {

/// Ends a run as a Ctrl-C would: while it lives, sets `cancel` when `seconds` have passed; 0 never
/// does. The time begins with the object. One at a time. It is a timer of the system and not a
/// thread, which may be denied.
class TimeLimit {
public:
    TimeLimit(double seconds, std::atomic<bool>& cancel);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;

    /// Has the time run out, before anything else has set `cancel`?
    bool reached() const;

private:
    bool is_set_ = false;
    struct sigaction before_ = {};
};

/// --limit-memory as a backstop: the system gives this process no more than `bytes`, and what the
/// program itself takes for its code, its compiler and its threads. 0 for no limit. What runs need
/// is counted before they begin (run/stage/memory.h); this is for all else.
void limit_memory(std::uint64_t bytes);

}  // namespace cascade
