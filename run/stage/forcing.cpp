// Samples the parts that depend on time alone. Finds their jumps and, for each sample, how long
// they stay near its value.
#include "run/stage/forcing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cascade {

namespace {

/// In a step, a part changes by at most this fraction of its range. So a step ends within each
/// pulse, and the error estimate then notices the pulse.
constexpr double most_of_range = 0.3;
/// The longest step, as a number of intervals.
constexpr std::size_t farthest = Forcing::intervals / 4;
/// A change within an interval may be a jump if it is at least the fraction `least_jump` of the
/// range, and more than `steeper` times as large as the changes of the adjacent intervals.
constexpr double least_jump = 1e-3, steeper = 4;
/// Steps end this fraction of the duration before a jump, which is more than rounding errors.
constexpr double before_jump = 1e-13;

}  // namespace

void Forcing::begin_reach() {
    if (reach_.empty()) reach_.assign(intervals, farthest);
}

void Forcing::add(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double most = most_of_range * (*high - *low);
    if (!(most > 0) || !std::isfinite(most)) return;
    begin_reach();
    has_rest_ = has_rest_ || std::adjacent_find(values.begin(), values.end()) != values.end();
    for (std::size_t n = 0; n < intervals; ++n) {
        std::size_t& reach = reach_[n];
        const std::size_t end = std::min(reach, intervals - n);
        std::size_t passed = 1;
        while (passed < end && std::abs(values[n + passed + 1] - values[n]) <= most &&
               std::abs(values[n + passed] - values[n]) <= most) {
            ++passed;
        }
        reach = passed;
    }
}

void Forcing::add_motion(std::span<const double> changes) {
    if (std::none_of(changes.begin(), changes.end(), [](double each) { return each > 0; })) return;
    has_motion_ = true;
    begin_reach();
    constexpr double part =
        static_cast<double>(intervals_of_motion) / static_cast<double>(intervals);
    const auto change_in = [&](std::size_t n) {
        const std::size_t k = n * changes.size() / intervals;
        return part * std::max(changes[k], changes[std::min(k + 1, changes.size() - 1)]);
    };
    double sum = 0;  // The sum of the changes in the intervals from `n` to `end` − 1.
    for (std::size_t n = 0, end = 0; n < intervals; ++n) {
        if (end <= n) {
            end = n;
            sum = 0;
        }
        while (end < intervals && sum + change_in(end) <= most_of_range) sum += change_in(end++);
        reach_[n] = std::clamp<std::size_t>(end - n, 1, reach_[n]);
        if (end > n) sum -= change_in(n);
    }
}

void Forcing::add_jumps(const std::vector<Jump>& jumps) {
    jumps_.insert(jumps_.end(), jumps.begin(), jumps.end());
    std::sort(jumps_.begin(), jumps_.end(),
              [](const Jump& a, const Jump& b) { return a.after < b.after; });
}

double Forcing::slack() const { return before_jump * interval_ * static_cast<double>(intervals); }

double Forcing::longest_step(double t) const {
    if (reach_.empty()) return std::numeric_limits<double>::infinity();
    const auto n = static_cast<std::size_t>(std::clamp(t / interval_, 0.0, double{intervals - 1}));
    const double longest = static_cast<double>(reach_[n]) * interval_;
    const auto next = std::find_if(jumps_.begin(), jumps_.end(),
                                   [&](const Jump& jump) { return jump.before - 2 * slack() > t; });
    return next == jumps_.end() ? longest : std::min(longest, next->before - slack() - t);
}

double Forcing::time_after(double t) const {
    for (const Jump& jump : jumps_) {
        if (jump.before - 2 * slack() <= t && t < jump.after) t = jump.after;
    }
    return t;
}

std::vector<double> values_over(double duration, const ValueAt& at) {
    std::vector<double> values;
    for (std::size_t n = 0; n <= Forcing::intervals; ++n) {
        values.push_back(
            at(duration * static_cast<double>(n) / static_cast<double>(Forcing::intervals)));
    }
    return values;
}

std::vector<Jump> find_jumps(const std::vector<double>& values, double duration,
                             const ValueAt& at) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double least = least_jump * (*high - *low);
    std::vector<Jump> jumps;
    if (!(least > 0) || !std::isfinite(least)) return jumps;
    const std::size_t last = values.size() - 1;
    const auto change = [&](std::size_t n) { return std::abs(values[n + 1] - values[n]); };
    const auto time_of = [&](std::size_t n) {
        return duration * static_cast<double>(n) / static_cast<double>(last);
    };
    for (std::size_t n = 0; n < last; ++n) {
        const double beside = std::max(n > 0 ? change(n - 1) : 0, n + 1 < last ? change(n + 1) : 0);
        const double whole = change(n);
        if (!(whole > std::max(least, steeper * beside))) continue;
        Jump jump{time_of(n), time_of(n + 1)};
        double a = values[n], b = values[n + 1];
        // If the change is steep but no jump, the values at both ends of the interval become nearly
        // equal when the ends approach each other.
        while (2 * std::abs(b - a) > whole) {
            const double middle = std::midpoint(jump.before, jump.after);
            if (!(middle > jump.before && middle < jump.after)) break;
            const double there = at(middle);
            if (std::abs(there - a) > std::abs(b - there)) {
                jump.after = middle;
                b = there;
            } else {
                jump.before = middle;
                a = there;
            }
        }
        if (2 * std::abs(b - a) > whole) jumps.push_back(jump);
    }
    return jumps;
}

}  // namespace cascade
