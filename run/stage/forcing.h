// How fast the rates of a stage, and the rules at its sides, change by themselves. An error
// estimate knows of such a change only after a step has passed over it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// A value at a time.
using ValueAt = std::function<double(double t)>;

/// Where a value jumps: between two times that are neighbours among numbers.
struct Jump {
    double before = 0, after = 0;
};

class Forcing {
public:
    /// The number of intervals of a stage's time at whose ends values are sampled. A shorter pulse
    /// may be missed.
    static constexpr std::size_t intervals = 10000;
    /// How far what moves goes is compared over this part of the time.
    static constexpr std::size_t intervals_of_motion = 1000;

    Forcing() = default;
    explicit Forcing(double duration) : interval_(duration / static_cast<double>(intervals)) {}

    /// Adds a part that is the same in all cells: its value at n / intervals of the duration.
    void add(const std::vector<double>& values);
    /// Adds what moves: `changes[m]` is the part of it that changes within a 1000th of the
    /// duration, at moments that are spread evenly over the duration.
    void add_motion(std::span<const double> changes);
    void add_jumps(const std::vector<Jump>& jumps);

    /// The longest step from `t` in which no part changes by more than three tenths of its range:
    /// at least one interval, at most a quarter of the duration. Infinite if no part changes. It
    /// ends just before a jump, after which the next step must begin at time_after().
    double longest_step(double t) const;
    /// The time after a jump that `t` has come to; else `t`.
    double time_after(double t) const;

private:
    double slack() const;
    void begin_reach();

    double interval_ = 0;
    std::vector<std::size_t> reach_;  ///< By interval: the number of intervals that a step may
                                      ///< pass; empty if nothing changes.
    std::vector<Jump> jumps_;         ///< In the order of time.
};

/// The values of a part at n / Forcing::intervals of a duration.
std::vector<double> values_over(double duration, const ValueAt& at);
/// Where a part whose values_over() are known jumps.
std::vector<Jump> find_jumps(const std::vector<double>& values, double duration, const ValueAt& at);

}  // namespace cascade
