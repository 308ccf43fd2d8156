#include "app/interrupt.h"

#include "app/exit_status.h"
#include "core/check.h"

#include <array>
#include <atomic>
#include <csignal>
#include <unistd.h>

namespace cascade {

namespace {

constexpr std::array watched_signals = {SIGINT, SIGTERM, SIGHUP};

// A signal handler is given nothing but a number: what it is to change can only be found in
// variables of the process. These two are the program's only ones, and lock-free.
std::atomic<std::atomic<bool>*> cancel_flag{nullptr};
std::atomic<int> received{0};
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free);
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int signal) {
    const bool is_second = received.exchange(signal) == SIGINT && signal == SIGINT;
    if (is_second) _exit(exit_status::signal_base + SIGINT);
    if (std::atomic<bool>* const flag = cancel_flag.load()) flag->store(true);
}

}  // namespace

struct InterruptGuard::Saved {
    std::array<struct sigaction, watched_signals.size()> actions;
};

InterruptGuard::InterruptGuard(RunControl& control) : saved_(std::make_unique<Saved>()) {
    CHECK(cancel_flag.load() == nullptr, "one run at a time is watched");
    received = 0;
    cancel_flag = &control.cancel;
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    for (std::size_t k = 0; k < watched_signals.size(); ++k) {
        sigaction(watched_signals[k], nullptr, &saved_->actions[k]);
        // What the caller has chosen to ignore (nohup, a job in the background) stays ignored.
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
    // Not SIG_IGN: InterruptGuard would take that for the wish never to be interrupted.
    struct sigaction action = {};
    action.sa_handler = [](int) {};
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
}

void ignore_broken_pipes() { std::signal(SIGPIPE, SIG_IGN); }

}  // namespace cascade
