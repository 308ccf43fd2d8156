// Compares bounds of eigenvalues with the stability interval of the solver. For
// Runge-Kutta-Legendre, chooses the number of stages with which a step is longest in relation to
// its number of stages.
#include "run/stage/automatic_speed.h"

#include "lang/program/program.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

namespace {

bool limits(double bound) { return std::isfinite(bound) && bound > 0; }

}  // namespace

double reaction_part_at(Solver solver, double tolerance) {
    constexpr double most = 6;
    const double part = reaction_part * std::pow(tolerance / StageTime::default_automatic_tolerance,
                                                 1.0 / order_of_estimate(solver));
    return std::min(part, is_partly_implicit(solver) ? reaction_part : most);
}

std::int64_t choose_every(Solver solver, bool by_rule) {
    return takes_long_steps(solver) && by_rule ? 10 : 100;
}

std::uint32_t choose_stages(Solver solver, const RateBounds& bounds, double step) {
    // Explicit Euler is stable for steps of at most 2 / bound.
    return stages_for(solver, step * bounds.whole / 2 / step_safety);
}

double stable_step(Solver solver, const RateBounds& bounds, std::uint32_t stages) {
    if (!limits(bounds.whole)) return std::numeric_limits<double>::infinity();
    return step_safety * stability_interval(solver, stages) / bounds.whole;
}

SafeStep safe_step(Solver solver, const RateBounds& bounds, double wanted, double part) {
    if (!takes_long_steps(solver)) return {std::min(wanted, stable_step(solver, bounds, 1)), 0};
    if (limits(bounds.reaction)) wanted = std::min(wanted, part / bounds.reaction);
    if (is_locally_implicit(solver)) return {std::min(wanted, stable_step(solver, bounds, 1)), 0};
    if (is_semi_implicit(solver)) return {wanted, 0};
    SafeStep best{0, least_stages(solver)};
    double most_per_stage = 0;
    for (std::uint32_t stages = least_stages(solver); stages <= most_stages; stages += 2) {
        const double step = std::min(wanted, stable_step(solver, bounds, stages));
        if (step / stages > most_per_stage) {
            most_per_stage = step / stages;
            best = {step, stages};
        }
        if (step == wanted) break;
    }
    return best;
}

}  // namespace cascade
