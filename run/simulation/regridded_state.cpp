// Copies what starting values and pictures read.
#include "run/simulation/regridded_state.h"

namespace cascade {

StageState regridded(const StageState& state, const Regridding& regridding) {
    StageState result;
    result.started = state.started;
    result.done = state.done;
    result.steps = state.steps;
    result.t = state.t;
    result.time = state.time;
    result.numbers = state.numbers;
    result.species_of_item = state.species_of_item;
    const auto all = [&](const auto& planes, auto& into) {
        for (const Field& plane : planes) {
            into.push_back(plane.empty() ? Field() : regridding.plane(plane));
        }
    };
    all(state.fields, result.fields);
    all(state.species, result.species);
    result.sides = state.sides;
    for (SideRules& rules : result.sides) {
        rules.spacing = regridding.spacing;
        for (std::size_t side = 0; side < side_count; ++side) {
            auto& values = rules.at[side].values;
            if (values) values = regridding.values(*values, side);
        }
    }
    return result;
}

}  // namespace cascade
