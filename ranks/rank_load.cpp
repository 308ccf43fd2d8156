// Reads processor times, and compares the times of ranks.
#include "ranks/rank_load.h"

#include <algorithm>
#include <vector>

namespace cascade {

double TimeOfSteps::processor_seconds(clockid_t clock) {
    struct timespec time = {};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::optional<SlowRank> slow_rank(std::span<const double> seconds) {
    if (seconds.size() < 2) return std::nullopt;
    std::vector<double> sorted(seconds.begin(), seconds.end());
    std::sort(sorted.begin(), sorted.end());
    const double median = sorted[(sorted.size() - 1) / 2];
    const double longest = sorted.back();
    if (longest < 1 || longest <= 2 * median) return std::nullopt;
    const auto place = std::max_element(seconds.begin(), seconds.end());
    // A median of 0 would make the multiple infinite.
    return SlowRank{static_cast<std::size_t>(place - seconds.begin()),
                    longest / std::max(median, 1e-3)};
}

}  // namespace cascade
