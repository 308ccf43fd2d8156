// Mean, deviation and confidence interval of a sample of numbers.
#pragma once

#include <cstddef>
#include <span>

namespace cascade {

/// Statistics of independent numbers, such as a feature in runs with different seeds.
struct Statistics {
    /// The number of values that are not NaN. All other values are ignored.
    std::size_t count = 0;
    double mean = 0;  ///< NaN if there are no numbers.
    /// The standard deviation of the sample, with count − 1 in the denominator. NaN if there are
    /// fewer than two numbers.
    double deviation = 0;
    /// The 95 % confidence interval of the mean by Student's t distribution (Student, The probable
    /// error of a mean, 1908): mean ± t deviation/√count. NaN if there are fewer than two numbers.
    double low = 0, high = 0;
};

Statistics statistics_of(std::span<const double> numbers);

}  // namespace cascade
