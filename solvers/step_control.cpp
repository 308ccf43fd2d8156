// Controls the length of adaptive steps.
#include "solvers/step_control.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

constexpr double safety = 0.9, least_factor = 0.2, most_factor = 5, least_after_rejection = 0.1;
/// The least error that counts. A step with almost no error says little about how long the next one
/// may be.
constexpr double least_error = 1e-10;

}  // namespace

bool StepControl::judge(double taken, double error) {
    const double k = order_;
    if (!(error <= 1)) {
        const double factor = std::isfinite(error) ? safety * std::pow(error, -1 / k) : 0;
        state_.step = taken * std::max(factor, least_after_rejection);
        state_.rejected = true;
        return false;
    }
    const double seen = std::max(error, least_error);
    // Whether another limit has shortened the step. The errors of shortened steps show no trend.
    const bool was_cut = taken < state_.step * (1 - 1e-9);
    double factor =
        was_cut ? safety * std::pow(seen, -1 / k)
                : safety * std::pow(seen, -0.7 / k) * std::pow(state_.error_before, 0.4 / k);
    factor = std::clamp(factor, least_factor, state_.rejected ? 1.0 : most_factor);
    // A step that was shortened at the end of a stage must not shorten the steps of a later stage.
    state_.step = std::max(taken * factor, taken < state_.step ? state_.step : 0);
    state_.error_before = seen;
    state_.rejected = false;
    return true;
}

void StepControl::forget_cut(const State& tried) {
    state_ = tried;
    state_.rejected = false;
}

}  // namespace cascade
