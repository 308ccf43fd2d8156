// The mean of numbers.
#pragma once

#include <numeric>
#include <vector>

namespace cascade::test {

inline double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace cascade::test
