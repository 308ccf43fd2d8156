// Interpolates the state of a stage between two complete steps, for pictures and logs. Steps never
// read the interpolated state.
#pragma once

#include "core/plane.h"
#include "run/simulation/simulation.h"
#include "run/simulation/stage_view.h"
#include "run/stage/stage_state.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cascade {

/// Interpolates values within a step. Each value follows Hermite's cubic curve, which has the
/// values and rates at both ends of the step. The error of this curve is of fourth order in the
/// length of the step. A solver may add a quartic term, with which the error is of fifth order
/// (Scheme::curve). If rates contain random numbers, values follow straight lines instead of
/// curves. A value also follows a straight line if it changes so fast at an end of a long step that
/// a cubic would swing far beyond both ends. A value that is the same at both ends is constant in
/// between.
class BetweenSteps {
public:
    /// Moments are counted from the present state, which must be a complete step. `view` and
    /// `state` must outlive this object. `has_long_steps` says whether a step may take longer than
    /// the fastest change of a value. `curve` returns Stepper::curve() of the step that led to the
    /// present state.
    BetweenSteps(const StageView& view, StageState& state, bool has_long_steps,
                 std::function<std::vector<Field>()> curve);

    /// Must be called at both ends of every step in which a moment may have to be observed. Calls
    /// `observe` for each moment since the previous step, while the stage temporarily has the state
    /// of that moment.
    void pass(const NextMoment& next, const std::function<void()>& observe,
              const std::atomic<bool>& cancel);

private:
    struct Moment {
        std::int64_t step = 0;
        double t = 0;
        std::vector<Field> species;
    };

    void keep_before(double next_moment);
    std::vector<Field> rates_before();
    std::vector<Field> at(double t);

    const StageView& view_;
    StageState& state_;
    bool has_long_steps_;
    std::function<std::vector<Field>()> curve_;
    /// Whether the rates at the ends of steps can be used. False if rates contain random numbers.
    bool has_slopes_;
    double last_;  ///< The moment that was observed last. At first, the start of the stage.
    /// The state at the previous step. Empty if no moment was expected after it.
    std::optional<Moment> before_;
    /// The rates at both ends of the present step. Empty until a moment needs them.
    std::vector<Field> slopes_before_, slopes_after_;
    /// The quartic term of the present step. Empty if the solver gives none.
    std::vector<Field> quartic_;
};

}  // namespace cascade
