// The team of threads and its barrier.
#include "core/parallel.h"

#include "core/check.h"
#include "core/floating_point.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sched.h>
#endif
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace cascade {
namespace {

/// Tells the core that this is a waiting loop, so that the core serves its other hyper-thread.
void relax() {
#if defined(__x86_64__)
    _mm_pause();
#else
    std::this_thread::yield();
#endif
}

/// Waits until `word` differs from `old`. Spins first, which responds within tens of nanoseconds
/// while every thread has a core. Then sleeps, which saves whole time slices on an oversubscribed
/// machine.
void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t old, int spins) {
    for (int spin = 0; spin < spins; ++spin) {
        if (word.load(std::memory_order_acquire) != old) return;
        relax();
    }
    for (int turn = 0; turn < 4; ++turn) {
        std::this_thread::yield();
        if (word.load(std::memory_order_acquire) != old) return;
    }
    while (word.load(std::memory_order_acquire) == old) {
        word.wait(old, std::memory_order_acquire);
    }
}

/// The number of processors that the CPU quota of this control group (version 2) allows; 0 if there
/// is no quota.
int quota_of_control_group() {
    std::FILE* file = std::fopen("/sys/fs/cgroup/cpu.max", "r");
    if (!file) return 0;
    double quota = 0, period = 0;
    const int read = std::fscanf(file, "%lf %lf", &quota, &period);  // Reads no number from "max".
    std::fclose(file);
    if (read != 2 || quota <= 0 || period <= 0) return 0;
    return std::max(1, static_cast<int>(std::lround(quota / period)));
}

}  // namespace

int hardware_threads() {
    int threads = static_cast<int>(std::thread::hardware_concurrency());
#if defined(__linux__)
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) threads = CPU_COUNT(&allowed);
#endif
    if (const int quota = quota_of_control_group(); quota > 0) threads = std::min(threads, quota);
    return std::max(threads, 1);
}

namespace {

/// Thrown at a barrier that another thread will never reach.
struct Abandoned {};

/// A reusable barrier. Each word that threads wait for has its own cache line.
struct Meeting {
    alignas(64) std::atomic<std::uint32_t> count{0};  ///< Number of completed meetings.
    /// Whether call_off() was called. Set before `count` is increased.
    std::atomic<bool> is_off{false};
    alignas(64) std::atomic<int> arrived{0};  ///< Number of threads that wait for the others.

    /// Ends the wait of the other threads, now and at later meetings.
    void call_off() {
        is_off = true;
        ++count;
        count.notify_all();
    }

    void arrive(int expected, int spins) {
        const std::uint32_t current = count.load(std::memory_order_acquire);
        if (is_off) throw Abandoned();
        if (arrived.fetch_add(1, std::memory_order_acq_rel) + 1 == expected) {
            arrived.store(0, std::memory_order_relaxed);
            count.store(current + 1, std::memory_order_release);
            count.notify_all();
        } else {
            wait_while(count, current, spins);
        }
        if (is_off) throw Abandoned();
    }
};

}  // namespace

struct Team::State {
    alignas(64) std::atomic<std::uint32_t> task{
        0};              ///< Counts calls of run(). Workers wait until the count changes.
    Meeting barrier;     ///< The active threads of a run wait here for each other.
    Meeting end_of_run;  ///< All threads of the team wait here for each other.
    alignas(64) const std::function<void(int)>* work = nullptr;  ///< Null tells workers to end.
    int active = 1;
    int size = 1;
    int spins = 0;
    std::vector<std::thread> workers;
    std::mutex of_error;
    std::exception_ptr error;  ///< The first exception of a run.

    /// Does a thread's work and stores the exception it throws.
    void attempt(int index) noexcept {
        try {
            (*work)(index);
        } catch (const Abandoned&) {  // The exception of another thread is reported.
        } catch (...) {
            const std::lock_guard lock(of_error);
            if (!error) error = std::current_exception();
            barrier.call_off();
        }
    }

    void serve(int index) {
        const FlushDenormals environment;
        for (std::uint32_t seen = 0;; ++seen) {
            wait_while(task, seen, spins);
            if (!work) return;
            if (index < active) attempt(index);
            end_of_run.arrive(size, spins);
        }
    }

    void start(const std::function<void(int)>* next) {
        work = next;
        task.fetch_add(1, std::memory_order_release);
        task.notify_all();
    }
};

Team::Team(int size) : state_(std::make_unique<State>()) {
    CHECK(size >= 1, "a team has at least one thread");
    state_->size = size;
    state_->spins = size <= hardware_threads() ? 4000 : 50;
    for (int index = 1; index < size; ++index) {
        try {
            state_->workers.emplace_back([state = state_.get(), index] { state->serve(index); });
        } catch (
            const std::exception&) {  // The system refused to start the thread, or memory ran out.
            state_->size = index;     // Workers read the size only when they have work.
            break;
        }
    }
}

Team::~Team() {
    if (!state_->workers.empty()) state_->start(nullptr);
    for (std::thread& worker : state_->workers) worker.join();
}

int Team::size() const { return state_->size; }

void Team::run(const std::function<void(int index)>& work) { run(work, state_->size); }

void Team::run(const std::function<void(int index)>& work, int active) {
    CHECK(1 <= active && active <= state_->size, "threads that the team has");
    const FlushDenormals environment;
    state_->active = active;
    if (active == 1) {
        work(0);
        return;
    }
    state_->start(&work);
    state_->attempt(0);
    state_->end_of_run.arrive(state_->size, state_->spins);
    if (!state_->error) return;
    state_->barrier.is_off = false;
    state_->barrier.arrived = 0;
    std::rethrow_exception(std::exchange(state_->error, nullptr));
}

void Team::barrier() {
    if (state_->active > 1) state_->barrier.arrive(state_->active, state_->spins);
}

namespace {

/// Thrown by abandon_work().
struct LeftUndone {};

}  // namespace

void abandon_work() { throw LeftUndone{}; }

bool complete(const std::function<void()>& work) {
    try {
        work();
        return true;
    } catch (const LeftUndone&) {
        return false;
    }
}

}  // namespace cascade
