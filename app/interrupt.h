// Handles Ctrl-C. The first press ends the run after a complete step, and the second press ends the
// program.
#pragma once

#include <atomic>
#include <memory>

namespace cascade {

/// As long as this object exists, SIGINT, SIGTERM and SIGHUP set `cancel`. A second SIGINT at least
/// 0.2 s after the first ends the program at once with status 130. Only one such object may exist
/// at a time.
class InterruptGuard {
public:
    explicit InterruptGuard(std::atomic<bool>& cancel);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Returns the number of the signal that has arrived, or 0 if none has.
    int signal() const;

private:
    struct Saved;
    std::unique_ptr<Saved> saved_;
};

/// From now on, SIGINT has no effect while no InterruptGuard exists, so that Ctrl-C does not end a
/// session at the prompt.
void stay_on_interrupt();

/// From now on, a write to a closed pipe or beyond the limit of the file size fails, instead of
/// causing a signal that ends the program.
void take_signals_of_writes_as_errors();

}  // namespace cascade
