#include "run/automatic_speed.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr double most_of_duration = 0.05, cautious_part = 0.001;

bool is_usable(double bound) { return std::isfinite(bound) && bound > 0; }

}  // namespace

std::int64_t choose_every(Solver solver, bool by_rule) {
    return takes_long_steps(solver) && by_rule ? 10 : 100;
}

std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step) {
    // The limit of explicit Euler is 2 / bound.
    return stages_for(solver, step * bounds.whole / 2 / step_safety);
}

StepChoice choose_step(Solver solver, const RateBounds& bounds, double duration) {
    StepChoice choice;
    const double longest = most_of_duration * duration;
    if (!std::isfinite(bounds.whole) || !std::isfinite(bounds.reaction)) {
        choice.step = cautious_part * duration;
        choice.stages = is_stabilised(solver) ? 3 : 0;
        return choice;
    }
    if (!takes_long_steps(solver)) {
        choice.step = longest;
        if (is_usable(bounds.whole)) {
            choice.step = std::min(longest, step_safety * stability_interval(solver) / bounds.whole);
        }
        return choice;
    }
    double wanted = longest;
    const double part = bounds.jumps ? reaction_part_with_jumps : reaction_part;
    if (is_usable(bounds.reaction)) wanted = std::min(wanted, part / bounds.reaction);
    if (is_semi_implicit(solver)) {
        choice.step = wanted;
        return choice;
    }
    double most_per_stage = 0;
    for (std::uint32_t stages = least_stages(solver); stages <= most_stages; stages += 2) {
        double step = wanted;
        if (is_usable(bounds.whole)) {
            step = std::min(step, step_safety * stability_interval(solver, stages) / bounds.whole);
        }
        if (step / stages > most_per_stage) {
            most_per_stage = step / stages;
            choice.step = step;
            choice.stages = stages;
        }
        if (step == wanted) break;
    }
    return choice;
}

}  // namespace cascade
