// Finds how fast the rates of a stage, and the rules at its sides, change with time alone. An error
// estimate would detect such a change only after a step has passed over it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cascade {

/// A value as a function of time.
using ValueAt = std::function<double(double t)>;

/// A jump of a value in time. `before` and `after` are adjacent floating-point times.
struct Jump {
    double before = 0, after = 0;
};

class Forcing {
public:
    /// The stage's time is divided into this number of intervals, and values are sampled at their
    /// ends. A pulse that is shorter than an interval may be missed.
    static constexpr std::size_t intervals = 10000;
    /// Changes in space are measured over the duration of the stage divided by this number.
    static constexpr std::size_t intervals_of_motion = 1000;

    Forcing() = default;
    explicit Forcing(double duration) : interval_(duration / static_cast<double>(intervals)) {}

    /// Adds a uniform part. `values[n]` is the value of the part at n / intervals of the duration.
    void add(const std::vector<double>& values);
    /// Adds a part that varies in space. `changes[m]` is the fraction of the part that changes
    /// within 1/1000 of the duration, at moments that are spread evenly over the duration.
    void add_motion(std::span<const double> changes);
    void add_jumps(const std::vector<Jump>& jumps);
    /// Whether a part that varies in space changes in time.
    bool has_motion() const { return has_motion_; }
    /// Whether a uniform part changes at some times and rests at others.
    bool has_rest() const { return has_rest_; }

    /// Returns the longest step from `t` in which no part changes by more than three tenths of its
    /// range. It is at least one interval and at most a quarter of the duration, but the step ends
    /// just before a jump. The next step must then begin at time_after(). Returns infinity if no
    /// part changes.
    double longest_step(double t) const;
    /// Returns the time just after a jump if `t` is just before this jump. Otherwise returns `t`.
    double time_after(double t) const;

private:
    double slack() const;
    void begin_reach();

    double interval_ = 0;
    bool has_motion_ = false, has_rest_ = false;
    /// For each interval, the number of intervals over which a step from there may pass. Empty if
    /// nothing changes.
    std::vector<std::size_t> reach_;
    std::vector<Jump> jumps_;  ///< In ascending order of their times.
};

/// Returns the values of a part at n / Forcing::intervals of a duration, for all n.
std::vector<double> values_over(double duration, const ValueAt& at);
/// Finds the jumps of a part. `values` are its values_over().
std::vector<Jump> find_jumps(const std::vector<double>& values, double duration, const ValueAt& at);

}  // namespace cascade
