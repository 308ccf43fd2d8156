// --limit-time and --limit-memory.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace cascade {

/// Ends a run as a Ctrl-C would: while it lives, sets `cancel` when `seconds` have passed; 0 never
/// does. The time begins with the object.
class TimeLimit {
public:
    TimeLimit(double seconds, std::atomic<bool>& cancel);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;

    /// Has the time run out, before anything else has set `cancel`?
    bool reached() const { return reached_; }

private:
    std::mutex mutex_;
    std::condition_variable over_;
    bool leaving_ = false;
    std::atomic<bool> reached_{false};
    std::thread clock_;
};

/// --limit-memory as a backstop: the system gives this process no more than `bytes`, and what the
/// program itself takes for its code, its compiler and its threads. 0 for no limit. What runs need
/// is counted before they begin (run/memory.h); this is for all else.
void limit_memory(std::uint64_t bytes);

}  // namespace cascade
