// Ctrl-C: the first ends the run at a complete step, the second ends the program.
#pragma once

#include <atomic>
#include <memory>

namespace cascade {

/// While it lives, SIGINT, SIGTERM and SIGHUP set `cancel`; a second SIGINT, a
/// fifth of a second later or more, leaves the program at once, with status 130. One at a time.
class InterruptGuard {
public:
    explicit InterruptGuard(std::atomic<bool>& cancel);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// The signal that came, 0 if none has.
    int signal() const;

private:
    struct Saved;
    std::unique_ptr<Saved> saved_;
};

/// SIGINT does nothing from now on, where no InterruptGuard lives: for a prompt, which is not left
/// by Ctrl-C.
void stay_on_interrupt();

/// Writing to a pipe that nobody reads any more, or more than a file may hold, becomes an error of
/// the write and not a signal that ends the program.
void take_signals_of_writes_as_errors();

}  // namespace cascade
