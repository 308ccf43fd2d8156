// --limit-time and --limit-memory.
#pragma once

#include <atomic>
#include <csignal>
#include <cstdint>

namespace cascade {

/// Sets `cancel` `seconds` after its construction, unless it is destroyed before; 0 is no limit.
/// Only one may exist at a time. It uses a system timer, since creating a thread may be denied.
class TimeLimit {
public:
    TimeLimit(double seconds, std::atomic<bool>& cancel);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;

    /// True if the time ran out before anything else set `cancel`.
    bool reached() const;

private:
    bool is_set_ = false;
    struct sigaction before_ = {};
};

/// --limit-memory as a backstop: the system gives this process at most `bytes` plus an allowance
/// for code, compiler and threads; 0 is no limit. The needs of a run are estimated before it starts
/// (run/stage/memory.h); this covers everything else.
void limit_memory(std::uint64_t bytes);

}  // namespace cascade
