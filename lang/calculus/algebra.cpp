// Simplifies calls, function by function.
#include "lang/calculus/algebra.h"

#include "lang/program/fold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace cascade {

/// A simpler node with the same value as the call; nullopt if there is none.
std::optional<NodeId> Algebra::simpler(Function function, const Operands& operands) {
    const auto [a, b, c] = std::array{operands[0], operands[1], operands[2]};
    const Node& first = (*this)[a];
    if (const auto known = without_zeros(function, a, b)) return known;
    switch (function) {
        case Function::subtract:
            if (a == b) return number(0);
            break;
        case Function::multiply:
            if (is_number(a, 1)) return b;
            if (is_number(b, 1)) return a;
            break;
        case Function::divide:
            if (is_number(b, 1)) return a;
            break;
        case Function::negate:
            if (first.calls(Function::negate)) return first.operands[0];
            break;
        case Function::abs:
            if (first.calls(Function::abs)) return a;
            if (first.calls(Function::negate)) return magnitude(first.operands[0]);
            break;
        case Function::power:
            if (is_number(b, 0)) return number(1);
            if (is_number(b, 1)) return a;
            break;
        case Function::max:
            if (a == b) return a;
            break;
        case Function::if_:
            if (b == c) return b;
            break;
        default: break;
    }
    return std::nullopt;
}

NodeId Algebra::call_of(const Node& node) {
    const auto [a, b, c] = std::array{node.operands[0], node.operands[1], node.operands[2]};
    switch (node.operand_count) {
        case 1: return call(node.function, {a});
        case 2: return call(node.function, {a, b});
        default: return call(node.function, {a, b, c});
    }
}

NodeId Algebra::call(Function function, std::initializer_list<NodeId> operands, ValueType type) {
    Operands all{};
    std::array<double, most_operands> values{};
    std::copy(operands.begin(), operands.end(), all.begin());
    if (const auto known = simpler(function, all)) return *known;
    std::size_t numbers = 0;
    for (const NodeId operand : operands) {
        if (const auto* value = (*this)[operand].as<double>()) values[numbers++] = *value;
    }
    const auto value = numbers == operands.size() ? fold(function, values) : std::nullopt;
    if (value && std::isfinite(*value)) return number(*value);
    return ExpressionGraph::call(function, operands, type);
}

Formula without_definitions(const System& system, const Formula& formula) {
    FlatRates flat(system);
    return flat.algebra.formula(flat.flattening.add(formula));
}

std::vector<Formula> near_distances(const Formula& formula) {
    std::vector<Formula> distances;
    for (const Node& node : formula.nodes) {
        const bool is_near =
            node.is<Call>() && is_over_neighbours(node.function) && node.operand_count == 2;
        if (is_near) distances.push_back(formula_of(formula.nodes, node.operands[1]));
    }
    return distances;
}

}  // namespace cascade
