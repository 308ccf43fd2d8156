// How values differ from each other: their mean, their deviation and their ends, and the one rule
// that says when values count as even.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

/// Values count as even where their standard deviation is at most this part of their largest
/// magnitude: what is left is rounding of binary32.
inline constexpr double even_deviation = 1e-5;
/// They also do where it is at most this: what is left is dying away.
inline constexpr double least_deviation = 1e-12;

/// Of values of any number. Those that are not finite do not count.
struct Spread {
    double count = 0;
    double mean = 0;
    double squares = 0;  ///< Sum of the squared distances from the mean.
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();

    double deviation() const { return count > 0 ? std::sqrt(squares / count) : 0; }
    double magnitude() const {
        return count > 0 ? std::max(std::abs(smallest), std::abs(largest)) : 0;
    }
    /// No values at all are even, too.
    bool is_even() const {
        return !(deviation() > std::max(even_deviation * magnitude(), least_deviation));
    }

    /// The spread of the values of both. T. F. Chan, G. H. Golub and R. J. LeVeque, "Updating
    /// formulae and a pairwise algorithm for computing sample variances", 1979.
    void add(const Spread& other);
};

/// `for_each(take)` calls `take(value)` for every value, in the same order each time: the squares
/// are taken about the mean, in a second pass, since a difference of sums would lose small
/// patterns.
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

}  // namespace cascade
