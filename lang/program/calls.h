// Tests of function calls in formulas.
#pragma once

#include "lang/program/formula.h"
#include "lang/vocabulary/function_groups.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// Whether the node is a call of a function with this property.
inline bool calls(const Node& node, bool (*has_property)(Function)) {
    return node.is<Call>() && has_property(node.function);
}

/// If the node is the solution of a constraint, the number of this constraint. nullopt for other
/// nodes.
inline std::optional<std::uint32_t> solved_constraint(const Node& node) {
    return node.calls(Function::solved) ? std::optional(node.as<Call>()->detail) : std::nullopt;
}

}  // namespace cascade
