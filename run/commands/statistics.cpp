// Passes over the numbers twice: for the mean, and for the squares of the differences from the
// mean.
#include "run/commands/statistics.h"

#include <boost/math/distributions/students_t.hpp>

#include <cmath>
#include <limits>

namespace cascade {

Statistics statistics_of(std::span<const double> numbers) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Statistics result{0, none, none, none, none};
    double sum = 0;
    for (const double number : numbers) {
        if (std::isnan(number)) continue;
        sum += number;
        ++result.count;
    }
    if (result.count == 0) return result;
    const auto count = static_cast<double>(result.count);
    result.mean = sum / count;
    if (result.count == 1) return result;
    double squares = 0;
    for (const double number : numbers) {
        if (!std::isnan(number)) squares += (number - result.mean) * (number - result.mean);
    }
    result.deviation = std::sqrt(squares / (count - 1));
    const double t = quantile(boost::math::students_t(count - 1), 0.975);
    const double half = t * result.deviation / std::sqrt(count);
    result.low = result.mean - half;
    result.high = result.mean + half;
    return result;
}

}  // namespace cascade
