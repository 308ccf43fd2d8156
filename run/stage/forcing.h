// The speed at which the rates of a stage, and the rules at its sides, change with time alone. An
// error estimate detects such a change only after a step has passed over it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// A value as a function of time.
using ValueAt = std::function<double(double t)>;

/// A jump of a value. `before` and `after` are adjacent floating-point times.
struct Jump {
    double before = 0, after = 0;
};

class Forcing {
public:
    /// Values are sampled at the ends of this number of intervals of the stage's time. A shorter
    /// pulse may be missed.
    static constexpr std::size_t intervals = 10000;
    /// Changes in space are measured over the duration of the stage divided by this number.
    static constexpr std::size_t intervals_of_motion = 1000;

    Forcing() = default;
    explicit Forcing(double duration) : interval_(duration / static_cast<double>(intervals)) {}

    /// Adds a part that is uniform. `values[n]` is its value at n / intervals of the duration.
    void add(const std::vector<double>& values);
    /// Adds a part that varies in space. `changes[m]` is the fraction of it that changes within
    /// 1/1000 of the duration, at moments that are spread evenly over the duration.
    void add_motion(std::span<const double> changes);
    void add_jumps(const std::vector<Jump>& jumps);
    /// Whether a part that varies in space changes.
    bool has_motion() const { return has_motion_; }
    /// Whether a uniform part changes at some times and rests at others.
    bool has_rest() const { return has_rest_; }

    /// The longest step from `t` in which no part changes by more than three tenths of its range.
    /// At least one interval and at most a quarter of the duration. Infinite if no part changes.
    /// The step ends just before a jump, and the next step must then begin at time_after().
    double longest_step(double t) const;
    /// The time just after a jump if `t` is just before one. Otherwise `t`.
    double time_after(double t) const;

private:
    double slack() const;
    void begin_reach();

    double interval_ = 0;
    bool has_motion_ = false, has_rest_ = false;
    /// For each interval, the number of intervals that a step may pass over. Empty if nothing
    /// changes.
    std::vector<std::size_t> reach_;
    std::vector<Jump> jumps_;  ///< In ascending order of time.
};

/// The values of a part at n / Forcing::intervals of a duration.
std::vector<double> values_over(double duration, const ValueAt& at);
/// Finds the jumps of a part with these values_over().
std::vector<Jump> find_jumps(const std::vector<double>& values, double duration, const ValueAt& at);

}  // namespace cascade
