// The length of adaptive steps.
//
// The controller is proportional-integral (K. Gustafsson, "Control theoretic techniques for
// stepsize selection in explicit Runge-Kutta methods", ACM Transactions on Mathematical Software
// 17, 1991; constants of E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 1996,
// section IV.2): next = step · 0.9 · error^(−0.7/k) · previous error^(0.4/k), where k is the order
// of the error estimate. The next step is limited to between a fifth and five times the step. After
// a step shorter than step(), and after a rejected step, next = step · 0.9 · error^(−1/k). After a
// rejected step the next one is at least a tenth of that step.
#pragma once

namespace cascade {

class StepControl {
public:
    /// The state that must be saved to continue without a break.
    struct State {
        double step = 0;          ///< The length of the next step to try, above 0.
        double error_before = 1;  ///< The error of the last accepted step.
        /// Whether the last step was rejected, so that the next one may not grow.
        bool rejected = false;
    };

    /// The error estimate is proportional to the length of the step to the power `order`.
    StepControl(double first_step, int order) : state_{first_step, 1, false}, order_(order) {}
    StepControl(const State& state, int order) : state_(state), order_(order) {}

    double step() const { return state_.step; }
    const State& state() const { return state_; }

    /// Judges a step of length `taken` by its error in units of the tolerance. `taken` is step(),
    /// or less near the end of a stage. Accepts the step, and returns true, if the error is at most
    /// 1. Rejects NaN and infinity.
    bool judge(double taken, double error);
    /// Must be called after an accepted step that was cut to end at a mark. The small error of such
    /// a step must not count as a trend, so the next length follows from `tried`, the state before
    /// that step.
    void forget_cut(const State& tried);

private:
    State state_;
    int order_;
};

}  // namespace cascade
