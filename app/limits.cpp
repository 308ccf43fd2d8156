#include "app/limits.h"

#include "core/parallel.h"

#include <algorithm>
#include <chrono>
#include <sys/resource.h>

namespace cascade {

TimeLimit::TimeLimit(double seconds, std::atomic<bool>& cancel) {
    if (!(seconds > 0)) return;
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                         std::chrono::duration<double>(seconds));
    clock_ = std::thread([this, end, &cancel] {
        std::unique_lock lock(mutex_);
        if (over_.wait_until(lock, end, [this] { return leaving_; })) return;
        if (!cancel.exchange(true)) reached_ = true;
    });
}

TimeLimit::~TimeLimit() {
    if (!clock_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    over_.notify_all();
    clock_.join();
}

void limit_memory(std::uint64_t bytes) {
    if (bytes == 0) return;
    // The stacks of threads count in full, used or not.
    constexpr std::uint64_t for_the_program = std::uint64_t{256} << 20;
    constexpr std::uint64_t for_a_thread = std::uint64_t{16} << 20;
    rlimit limit = {};
    getrlimit(RLIMIT_DATA, &limit);
    const rlim_t wanted =
        bytes + for_the_program + static_cast<std::uint64_t>(hardware_threads()) * for_a_thread;
    limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? wanted : std::min(wanted, limit.rlim_max);
    setrlimit(RLIMIT_DATA, &limit);  // Where the system knows no such limit, the count remains.
}

}  // namespace cascade
