// Cancels work that takes too long.
#pragma once

#include <atomic>
#include <memory>

namespace cascade {

/// Sets `cancel` after this many seconds, unless it is destroyed before. 0 seconds: never.
class Deadline {
public:
    Deadline(double seconds, std::atomic<bool>& cancel);
    ~Deadline();
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;

    /// Whether the time was over. If so, resets `cancel`. From now on `cancel` stays unchanged.
    bool ends_work();

private:
    struct Clock;
    std::unique_ptr<Clock> clock_;  ///< Null without a limit.
};

}  // namespace cascade
