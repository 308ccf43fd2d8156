// Samples the parts that depend on time alone, and computes for each sample how long they stay
// close to it.
#include "run/stage/forcing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

namespace {

/// Once a step ends within a pulse, error estimates know of it.
constexpr double most_of_range = 0.3;
/// No step is longer than this part of the time.
constexpr std::size_t farthest = Forcing::intervals / 4;

}  // namespace

Forcing::Forcing(const std::vector<std::vector<double>>& values, double duration)
    : interval_(duration / static_cast<double>(intervals)) {
    for (const std::vector<double>& part : values) {
        const auto [low, high] = std::minmax_element(part.begin(), part.end());
        const double most = most_of_range * (*high - *low);
        if (!(most > 0) || !std::isfinite(most)) continue;
        if (reach_.empty()) reach_.assign(intervals, farthest);
        for (std::size_t n = 0; n < intervals; ++n) {
            std::size_t& reach = reach_[n];
            const std::size_t end = std::min(reach, intervals - n);
            std::size_t passed = 1;
            while (passed < end && std::abs(part[n + passed + 1] - part[n]) <= most &&
                   std::abs(part[n + passed] - part[n]) <= most) {
                ++passed;
            }
            reach = passed;
        }
    }
}

double Forcing::longest_step(double t) const {
    if (reach_.empty()) return std::numeric_limits<double>::infinity();
    const auto n = static_cast<std::size_t>(std::clamp(t / interval_, 0.0, double{intervals - 1}));
    return static_cast<double>(reach_[n]) * interval_;
}

}  // namespace cascade
