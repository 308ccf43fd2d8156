// Tests of nodes, and searches in the formulas of rates and in the formulas of rules at sides.
#pragma once

#include "lang/program/program.h"

#include <algorithm>
#include <cstdint>

namespace cascade {

/// Whether the node reads a species of the formula's own stage.
inline bool is_species(const System& system, const Node& node) {
    const auto* item = node.as<ItemId>();
    return item != nullptr && system.is_species(*item);
}

/// Whether the node reads the time t or the number of completed steps.
inline bool is_moment(const Node& node) { return node.is(Builtin::t) || node.is(Builtin::step); }

/// Whether `test` holds for some node of the formula.
template <typename Test>
bool holds_in(const Formula& formula, const Test& test) {
    return std::any_of(formula.nodes.begin(), formula.nodes.end(), test);
}

/// The first node for which `test` holds, in the definitions and then in the rates; null if there
/// is none.
template <typename Test>
const Node* find_in_rates(const System& system, const Test& test) {
    const auto find_in = [&](const Formula& formula) -> const Node* {
        const auto found = std::find_if(formula.nodes.begin(), formula.nodes.end(), test);
        return found == formula.nodes.end() ? nullptr : &*found;
    };
    for (const Definition& definition : system.definitions) {
        if (const Node* found = find_in(definition.formula)) return found;
    }
    for (const Formula& rate : system.rates) {
        if (const Node* found = find_in(rate)) return found;
    }
    return nullptr;
}

/// Calls visit(kernel) for the kernel of each convolution in a stage: in its values, rates,
/// definitions, picture and end condition (`until`).
template <typename Visit>
void for_each_kernel_of_stage(const Program& program, std::uint32_t stage, const Visit& visit) {
    const Stage& own = program.stages[stage];
    const System& system = program.system_of(stage);
    const auto look_in = [&](const Formula& formula) {
        for_each_kernel(formula, *program.literals, visit);
    };
    for (const Formula& rate : system.rates) look_in(rate);
    for (const Definition& definition : system.definitions) look_in(definition.formula);
    for (const Formula& item : own.items) look_in(item);
    look_in(own.show);
    if (own.time.until) look_in(*own.time.until);
}

template <typename Test>
bool holds_in_rates(const System& system, const Test& test) {
    return find_in_rates(system, test) != nullptr;
}

/// Whether `test` holds for some node in the rules at the sides of a stage.
template <typename Test>
bool holds_in_sides(const Stage& stage, const Test& test) {
    const auto is_in = [&](const auto& sides) {
        return std::any_of(sides.begin(), sides.end(),
                           [&](const SideSetting& side) { return holds_in(side.value, test); });
    };
    return std::any_of(stage.sides.begin(), stage.sides.end(), is_in) ||
           std::any_of(stage.definition_sides.begin(), stage.definition_sides.end(),
                       [&](const DefinitionSides& each) { return is_in(each.sides); });
}

}  // namespace cascade
