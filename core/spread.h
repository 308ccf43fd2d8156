// Mean, standard deviation and range of values, and the rule for when values count as uniform.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace cascade {

/// Values count as uniform if their standard deviation is at most this fraction of their largest
/// magnitude. The fraction is about a hundred times the relative rounding error of binary32.
inline constexpr double uniform_deviation = 1e-5;
/// Values also count as uniform if their standard deviation is at most this fraction of the largest
/// magnitude that they ever had: such small differences are the remains of a pattern that has died
/// away.
inline constexpr double remaining_part = 1e-12;

/// The statistics of a set of values. Non-finite values are ignored.
struct Spread {
    double count = 0;
    double mean = 0;
    double squares = 0;  ///< Sum of the squared differences from the mean.
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();

    double deviation() const { return count > 0 ? std::sqrt(squares / count) : 0; }
    double magnitude() const {
        return count > 0 ? std::max(std::abs(smallest), std::abs(largest)) : 0;
    }
    /// Whether the values count as uniform. True for an empty set. `once` is the largest magnitude
    /// that the values had earlier. There is no absolute threshold, because users choose the units.
    bool is_uniform(double once = 0) const {
        return !(deviation() > std::max(uniform_deviation * magnitude(), remaining_part * once));
    }
    /// Whether all values are the same number.
    bool is_one_number() const { return !(smallest < largest); }

    /// Merges in another set of values, without cancellation: T. F. Chan, G. H. Golub and R. J.
    /// LeVeque, "Updating formulae and a pairwise algorithm for computing sample variances", 1979.
    void add(const Spread& other);
};

/// The statistics of values. `for_each(take)` calls `take(value)` for every value, in the same
/// order each time. Squared differences from the mean are summed in a second pass, because a
/// difference of sums would lose small patterns.
template <typename ForEach>
Spread spread_of(const ForEach& for_each) {
    Spread spread;
    double sum = 0;
    for_each([&](double value) {
        if (!std::isfinite(value)) return;
        sum += value;
        spread.count += 1;
        spread.smallest = std::min(spread.smallest, value);
        spread.largest = std::max(spread.largest, value);
    });
    if (spread.count == 0) return spread;
    spread.mean = sum / spread.count;
    for_each([&](double value) {
        const double apart = value - spread.mean;
        if (std::isfinite(value)) spread.squares += apart * apart;
    });
    return spread;
}

/// The statistics of adjacent values. If `counts` is not null, ignores the values where `counts` is
/// 0. Several times as fast if no value is ignored and all are finite.
Spread spread_of(std::span<const float> values, const std::uint8_t* counts = nullptr);
Spread spread_of(std::span<const double> values, const std::uint8_t* counts = nullptr);

}  // namespace cascade
