// The length of adaptive steps.
//
// The controller is proportional-integral (K. Gustafsson, "Control theoretic techniques for
// stepsize selection in explicit Runge-Kutta methods", ACM Transactions on Mathematical Software
// 17, 1991; constants of E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 1996,
// section IV.2): next = step · 0.9 · error^(−0.7/k) · previous error^(0.4/k), where k is the order
// of the error estimate, limited to between a fifth and five times the step. After a step shorter
// than step(), next = step · 0.9 · error^(−1/k). So it is after a rejected step, but at least a
// tenth of it.
#pragma once

namespace cascade {

class StepControl {
public:
    /// The state that must be saved to continue without a break.
    struct State {
        double step = 0;          ///< The next step to try, above 0.
        double error_before = 1;  ///< The error of the last accepted step.
        bool rejected = false;    ///< The last step was rejected, so the next one may not grow.
    };

    /// The error estimate is proportional to this power `order` of the step.
    StepControl(double first_step, int order) : state_{first_step, 1, false}, order_(order) {}
    StepControl(const State& state, int order) : state_(state), order_(order) {}

    double step() const { return state_.step; }
    const State& state() const { return state_; }

    /// Judges a step of length `taken` (step(), or shorter near the end of a stage) by its error in
    /// units of the tolerance. Returns whether it is accepted, that is, whether the error is at
    /// most 1. NaN and infinity are rejected.
    bool judge(double taken, double error);

private:
    State state_;
    int order_;
};

}  // namespace cascade
