// Implements the options --limit-time and --limit-memory.
#pragma once

#include <atomic>
#include <csignal>
#include <cstdint>

namespace cascade {

/// After a number of seconds, sets `cancel` and begins the program's last moments
/// (app/last_moments.h), unless this object is destroyed before. 0 means no limit. Only one such
/// object may exist at a time. Uses a system timer, because creating a thread may be forbidden.
class TimeLimit {
public:
    TimeLimit(double seconds, std::atomic<bool>& cancel);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;

    /// Whether the time ran out before anything else set `cancel`.
    bool reached() const;

private:
    bool is_set_ = false;
    struct sigaction before_ = {};
};

/// Limits the memory of this process to `bytes`, plus an allowance for code, compiler and threads.
/// 0 means no limit. The memory for the planes of a run is estimated before the run starts
/// (run/stage/memory.h). This limit applies to all memory. If `ulimit -v` limits addresses, all
/// threads share one heap from now on.
void limit_memory(std::uint64_t bytes);

}  // namespace cascade
