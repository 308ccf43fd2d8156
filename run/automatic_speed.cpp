#include "run/automatic_speed.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr double most_of_duration = 0.05, cautious_part = 0.001;

bool is_usable(double bound) { return std::isfinite(bound) && bound > 0; }

}  // namespace

double fastest_growth(const DiffusionTerms<double>& least, const Grid& grid) {
    constexpr int samples = 400;
    constexpr double range = 1e8;
    const double largest = 4 * grid.stencil().axes() / (grid.spacing * grid.spacing);
    const double axis = std::min({least[4], least[5], least[6]});
    double fastest = 0;
    for (int n = 0; n <= samples; ++n) {
        const double q = largest * std::pow(range, -n / double{samples});
        const double damping =
            q * (axis + least[0] + q * (least[1] + q * (least[2] + q * least[3])));
        fastest = std::max(fastest, -damping);
    }
    return fastest;
}

std::int64_t choose_every(Solver solver) { return takes_long_steps(solver) ? 10 : 100; }

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
    if (is_semi_implicit(solver)) {
        choice.step = longest;
        if (is_usable(bounds.reaction)) {
            choice.step = std::min(longest, reaction_part / bounds.reaction);
        }
        return choice;
    }
    if (!is_stabilised(solver)) {
        choice.step = longest;
        if (is_usable(bounds.whole)) {
            choice.step = std::min(longest, step_safety * stability_interval(solver) / bounds.whole);
        }
        return choice;
    }
    choice.step = longest;
    if (is_usable(bounds.reaction)) {
        choice.step = std::min(longest, reaction_part / bounds.reaction);
    }
    choice.stages = choose_stages(solver, bounds, choice.step);
    if (is_usable(bounds.whole)) {
        // More stages than there may be would be needed: then diffusion decides after all.
        choice.step = std::min(choice.step, step_safety * stability_interval(solver, choice.stages) /
                                                bounds.whole);
    }
    return choice;
}

}  // namespace cascade
