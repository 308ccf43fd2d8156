// Limits time by setitimer() and SIGALRM, and memory by RLIMIT_DATA.
#include "app/limits.h"

#include "app/exit_status.h"
#include "app/last_moments.h"
#include "core/check.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/time.h>

namespace cascade {

namespace {

// These variables are global because the signal handler changes them.
std::atomic<std::atomic<bool>*> limited{nullptr};
std::atomic<bool> is_reached{false};
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free);

extern "C" void on_alarm(int) {
    std::atomic<bool>* const cancel = limited.load();
    if (!cancel || cancel->exchange(true)) return;
    is_reached = true;
    begin_last_moments(exit_status::time_limit);
}

void set_timer(double seconds) {
    itimerval timer = {};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - std::floor(seconds)) * 1e6);
    if (seconds > 0 && timer.it_value.tv_sec == 0) {
        timer.it_value.tv_usec =
            std::max<suseconds_t>(timer.it_value.tv_usec, 1);  // 0 would disarm the timer.
    }
    setitimer(ITIMER_REAL, &timer, nullptr);
}

/// If `ulimit -v` limits addresses, makes all threads use the same heap. Otherwise glibc would give
/// each thread a heap that reserves 64 MiB of addresses, and the run would lack these addresses.
void share_heap_of_threads() {
#ifdef __GLIBC__
    rlimit addresses = {};
    const bool is_limited =
        getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY;
    if (is_limited) mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace

TimeLimit::TimeLimit(double seconds, std::atomic<bool>& cancel) {
    if (!(seconds > 0)) return;
    CHECK(limited.load() == nullptr, "one run at a time has a limit");
    is_set_ = true;
    is_reached = false;
    limited = &cancel;
    struct sigaction action = {};
    action.sa_handler = on_alarm;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGALRM, &action, &before_);
    set_timer(seconds);
}

TimeLimit::~TimeLimit() {
    if (!is_set_) return;
    set_timer(0);
    sigaction(SIGALRM, &before_, nullptr);
    limited = nullptr;
}

bool TimeLimit::reached() const { return is_set_ && is_reached; }

void limit_memory(std::uint64_t bytes) {
    share_heap_of_threads();
    if (bytes == 0) return;
    // An allowance for the program itself. The system counts the whole stack of each thread,
    // whether the thread uses it or not.
    constexpr std::uint64_t for_the_program = std::uint64_t{256} << 20;
    constexpr std::uint64_t for_a_thread = std::uint64_t{16} << 20;
    rlimit limit = {};
    getrlimit(RLIMIT_DATA, &limit);
    const rlim_t wanted =
        bytes + for_the_program + static_cast<std::uint64_t>(hardware_threads()) * for_a_thread;
    limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? wanted : std::min(wanted, limit.rlim_max);
    // If the system has no such limit, this may fail. In any case, the memory of a run is estimated
    // before the run starts.
    setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace cascade
