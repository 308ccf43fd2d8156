// Signal handlers only set lock-free atomic flags or call _exit(), because little else is allowed
// in them.
#include "app/interrupt.h"

#include "app/exit_status.h"
#include "app/last_moments.h"
#include "core/check.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <unistd.h>

namespace cascade {

namespace {

constexpr std::array watched_signals = {SIGINT, SIGTERM, SIGHUP};

/// A single Ctrl-C may send two signals at almost the same time, from the terminal and from a
/// wrapper such as timeout(1). A user needs more time than this to press the key twice.
constexpr std::int64_t least_milliseconds_between = 200;

// A signal handler receives only a number, so everything that it changes must be global. These
// three variables, the variables of TimeLimit and LastMoments, and the slots of temporary files are
// the program's only global variables. All are lock-free.
std::atomic<std::atomic<bool>*> cancel_flag{nullptr};
std::atomic<int> received{0};
/// The time of the first SIGINT in milliseconds. 0 if there was none.
std::atomic<std::int64_t> interrupted_at{0};
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free);
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t milliseconds_now() {
    timespec now = {};
    clock_gettime(CLOCK_MONOTONIC, &now);  // This function is async-signal-safe.
    return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000 + 1;
}

extern "C" void on_signal(int signal) {
    if (signal == SIGINT) {
        const std::int64_t now = milliseconds_now();
        std::int64_t first = 0;
        const bool is_first = interrupted_at.compare_exchange_strong(first, now);
        if (!is_first && now - first >= least_milliseconds_between) {
            _exit(exit_status::signal_base + SIGINT);
        }
    }
    int none = 0;
    received.compare_exchange_strong(none, signal);
    if (signal != SIGINT) begin_last_moments(exit_status::signal_base + signal);
    if (std::atomic<bool>* const flag = cancel_flag.load()) flag->store(true);
}

}  // namespace

struct InterruptGuard::Saved {
    std::array<struct sigaction, watched_signals.size()> actions;
};

InterruptGuard::InterruptGuard(std::atomic<bool>& cancel) : saved_(std::make_unique<Saved>()) {
    CHECK(cancel_flag.load() == nullptr, "one run at a time is watched");
    received = 0;
    interrupted_at = 0;
    cancel_flag = &cancel;
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    for (std::size_t k = 0; k < watched_signals.size(); ++k) {
        sigaction(watched_signals[k], nullptr, &saved_->actions[k]);
        // A signal that the parent process ignores (nohup, a background job) remains ignored.
        if (saved_->actions[k].sa_handler == SIG_IGN) continue;
        sigaction(watched_signals[k], &action, nullptr);
    }
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t k = 0; k < watched_signals.size(); ++k) {
        sigaction(watched_signals[k], &saved_->actions[k], nullptr);
    }
    cancel_flag = nullptr;
}

int InterruptGuard::signal() const { return received.load(); }

void stay_on_interrupt() {
    // SIG_IGN would be wrong here, because InterruptGuard leaves ignored signals ignored.
    struct sigaction action = {};
    action.sa_handler = [](int) {};
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
}

void take_signals_of_writes_as_errors() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace cascade
