// The state of a stage between two complete steps, for observers. Steps do not depend on it.
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

/// Between the ends of a step, each value lies on the cubic curve that has the values and the rates
/// of both ends (Hermite's): its error is of fourth order in the length of the step. If rates draw
/// random numbers, it lies on a straight line. A value that is the same at both ends stays so.
class BetweenSteps {
public:
    /// Both must outlive it. The stage is at a complete step, from which moments count.
    BetweenSteps(const StageView& view, StageState& state);

    /// To be called at every complete step from whose next one a moment may be read, and at that
    /// one. Calls `observe` for each moment since the step before, with the state of the stage as
    /// it was then.
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
    bool has_slopes_;               ///< No random numbers in rates.
    double last_;                   ///< The last moment that was observed, or the start.
    std::optional<Moment> before_;  ///< The step before, where a moment may follow it.
    std::vector<Field> slopes_before_, slopes_after_;  ///< For moments in the same step.
};

}  // namespace cascade
