// Two timers of the system send SIGPROF: one measures the processor time of all threads, the other
// measures real time. Their handler calls only functions that POSIX allows in handlers.
#include "app/last_moments.h"

#include "app/exit_status.h"
#include "core/check.h"
#include "core/processor_time.h"
#include "core/temporary_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <ctime>
#include <string_view>
#include <unistd.h>

namespace cascade {

namespace {

constexpr double usual_seconds = 2, clock_seconds = 5;
constexpr double part_of_limit = 0.1;
constexpr std::string_view farewell =
    "cascade: ended at once, because the missing outputs would take too long\n";

/// The data that signal handlers read and change. They must be global, because a handler receives
/// only the number of the signal.
struct Moments {
    std::atomic<bool> exist{false};
    std::atomic<std::atomic<bool>*> hurry{nullptr};
    std::atomic<const std::atomic<bool>*> may_end{nullptr};
    std::atomic<int> status{0};  ///< 0 until the last moments begin.
    std::atomic<double> seconds_at_limit{usual_seconds};
    std::atomic<double> begin{0}, seconds{usual_seconds};  ///< In seconds of processor time.
    timer_t of_processor{}, of_clock{};
};
Moments moments_left;
static_assert(std::atomic<double>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

timespec duration(double seconds) {
    const auto whole = static_cast<std::time_t>(seconds);
    return {whole, static_cast<long>(1e9 * (seconds - static_cast<double>(whole)))};
}

void leave() {
    TemporaryFile::remove_all();
    (void)!::write(STDERR_FILENO, farewell.data(), farewell.size());
    ::_exit(moments_left.status);
}

extern "C" void on_last_moments(int) {
    if (moments_left.status == 0 || !moments_left.exist) return;
    *moments_left.hurry.load() = true;
    const double used = processor_seconds() - moments_left.begin;
    if (used >= moments_left.seconds && *moments_left.may_end.load()) leave();
}

}  // namespace

struct LastMoments::Timers {
    struct sigaction before = {};
    bool has_processor = false, has_clock = false;
};

LastMoments::LastMoments(double limit_seconds, std::atomic<bool>& hurry,
                         const std::atomic<bool>& may_end)
    : timers_(std::make_unique<Timers>()) {
    CHECK(!moments_left.exist, "the last moments of one run are watched at a time");
    moments_left.hurry = &hurry;
    moments_left.may_end = &may_end;
    moments_left.status = 0;
    moments_left.seconds_at_limit = std::max(usual_seconds, part_of_limit * limit_seconds);
    struct sigaction action = {};
    action.sa_handler = on_last_moments;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGPROF, &action, &timers_->before);
    sigevent event = {};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGPROF;
    timers_->has_processor =
        timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &moments_left.of_processor) == 0;
    timers_->has_clock = timer_create(CLOCK_MONOTONIC, &event, &moments_left.of_clock) == 0;
    moments_left.exist = timers_->has_processor && timers_->has_clock;
}

LastMoments::~LastMoments() {
    moments_left.exist = false;
    if (timers_->has_processor) timer_delete(moments_left.of_processor);
    if (timers_->has_clock) timer_delete(moments_left.of_clock);
    sigaction(SIGPROF, &timers_->before, nullptr);
}

void begin_last_moments(int status) noexcept {
    int none = 0;
    if (!moments_left.exist || !moments_left.status.compare_exchange_strong(none, status)) return;
    const double seconds =
        status == exit_status::time_limit ? moments_left.seconds_at_limit.load() : usual_seconds;
    moments_left.begin = processor_seconds();
    moments_left.seconds = 0.95 * seconds;  // Ending the program takes the rest of the time.
    const itimerspec processor = {duration(seconds / 20), duration(seconds / 2)};
    timer_settime(moments_left.of_processor, 0, &processor, nullptr);
    const itimerspec clock = {{}, duration(std::max(clock_seconds, 2.5 * seconds))};
    timer_settime(moments_left.of_clock, 0, &clock, nullptr);
}

}  // namespace cascade
