// How fast the rates of a stage change with time alone. An error estimate knows of such a change
// only after a step has passed over it.
#pragma once

#include <cstddef>
#include <vector>

namespace cascade {

class Forcing {
public:
    /// The number of intervals of a stage's time at whose ends values are sampled. A shorter pulse
    /// may be missed.
    static constexpr std::size_t intervals = 10000;

    Forcing() = default;
    /// `values[part][n]` is the value of a part of the rates at n / intervals of `duration`.
    Forcing(const std::vector<std::vector<double>>& values, double duration);

    /// The longest step from `t` in which no part changes by more than three tenths of its range:
    /// at least one interval, at most a quarter of the duration. Infinite if no part changes.
    double longest_step(double t) const;

private:
    double interval_ = 0;
    std::vector<std::size_t> reach_;  ///< By interval: the number of intervals that a step may
                                      ///< pass; empty if nothing changes.
};

}  // namespace cascade
