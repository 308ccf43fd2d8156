// Searches formulas for calls that draw; a rate that draws at each step needs to know the step's
// length.
#include "lang/check/chance.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

bool is_draw(const Node& node) {
    return node.kind == NodeKind::call && is_random(node.function);
}

bool draws(const Formula& formula) {
    return std::any_of(formula.nodes.begin(), formula.nodes.end(), is_draw);
}

/// The first node of the rates, and of what they are made of, that draws anew at each step without
/// knowing how long it is; nullptr where there is none.
const Node* find_draw_by_step(const System& system) {
    const auto find_in = [](const Formula& formula) -> const Node* {
        for (const Node& node : formula.nodes) {
            if (is_draw(node) && node.function != Function::white) return &node;
        }
        return nullptr;
    };
    for (const Definition& definition : system.definitions) {
        if (const Node* const found = find_in(definition.formula)) return found;
    }
    for (const Formula& rate : system.rates) {
        if (const Node* const found = find_in(rate)) return found;
    }
    return nullptr;
}

}  // namespace

bool draws_random_numbers(const Program& program) {
    if (program.domain.mask && draws(program.domain.mask->formula)) return true;
    for (const Stage& stage : program.stages) {
        const System& system = program.systems[stage.system];
        const bool is_in_steps =
            std::any_of(system.rates.begin(), system.rates.end(), draws) ||
            std::any_of(system.definitions.begin(), system.definitions.end(),
                        [](const Definition& each) { return draws(each.formula); });
        const bool is_in_sides =
            std::any_of(stage.sides.begin(), stage.sides.end(), [](const auto& sides) {
                return std::any_of(sides.begin(), sides.end(),
                                   [](const SideSetting& side) { return draws(side.value); });
            });
        if (is_in_steps || is_in_sides ||
            std::any_of(stage.items.begin(), stage.items.end(), draws))
            return true;
    }
    return false;
}

void warn_of_draws_by_step(const Program& program, Diagnostics& diagnostics) {
    for (const Stage& stage : program.stages) {
        if (!stage.time.chooses_steps()) continue;
        const Node* const draw = find_draw_by_step(program.systems[stage.system]);
        if (draw == nullptr) continue;
        return diagnostics.warning(draw->span,
                                   fmt::format("this is drawn anew at each step, and stage '{}' "
                                               "chooses how long its steps are: the "
                                               "shorter they are, the weaker the noise",
                                               stage.name),
                                   "white(s) is as strong with any steps");
    }
}

}  // namespace cascade
