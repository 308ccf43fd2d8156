// What the rates of a system are made of.
#pragma once

#include "lang/program/program.h"

#include <algorithm>

namespace cascade {

/// Does `test` hold for a node of a rate, or of a definition?
template <typename Test>
bool holds_in_rates(const System& system, const Test& test) {
    const auto holds = [&](const Formula& formula) {
        return std::any_of(formula.nodes.begin(), formula.nodes.end(), test);
    };
    return std::any_of(system.rates.begin(), system.rates.end(), holds) ||
           std::any_of(system.definitions.begin(), system.definitions.end(),
                       [&](const Definition& definition) { return holds(definition.formula); });
}

}  // namespace cascade
