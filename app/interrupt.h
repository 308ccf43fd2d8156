// Ctrl-C: the first one ends the run after a complete step, the second one ends the program.
#pragma once

#include <atomic>
#include <memory>

namespace cascade {

/// While it exists, SIGINT, SIGTERM and SIGHUP set `cancel`; a second SIGINT, at least 0.2 s after
/// the first, ends the program at once with status 130. Only one may exist at a time.
class InterruptGuard {
public:
    explicit InterruptGuard(std::atomic<bool>& cancel);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// The signal that arrived, 0 if none.
    int signal() const;

private:
    struct Saved;
    std::unique_ptr<Saved> saved_;
};

/// From now on SIGINT does nothing while no InterruptGuard exists: Ctrl-C does not leave the
/// prompt.
void stay_on_interrupt();

/// Writing to a closed pipe, or beyond the file size limit, becomes an error of the write instead
/// of a signal that ends the program.
void take_signals_of_writes_as_errors();

}  // namespace cascade
