// Cancels work that takes too long.
#pragma once

#include <atomic>
#include <memory>

namespace cascade {

/// Sets `cancel` after a number of seconds, unless the deadline is destroyed before. 0 seconds:
/// `cancel` is never set.
class Deadline {
public:
    Deadline(double seconds, std::atomic<bool>& cancel);
    ~Deadline();
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;

    /// Ends the deadline, which no longer changes `cancel` afterwards. If the time was over, resets
    /// `cancel` and returns true.
    bool ends_work();

private:
    struct Clock;
    std::unique_ptr<Clock> clock_;  ///< Null without a limit.
};

}  // namespace cascade
