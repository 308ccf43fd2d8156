// Defines the functions of vectors once for all kinds of numbers and vectors.
//
// In a cell a vector is three numbers (of_components): doubles in shapes, otherwise terms of a
// graph. In systems of fields, vectors can also be flows through faces, slopes or symbols
// (vector_by). Vectors of these kinds have only sums and multiples, so field_vectors.h rewrites all
// other functions as sums and multiples.
#pragma once

#include "core/check.h"
#include "core/vector3.h"
#include "lang/program/program.h"

#include <array>
#include <span>

namespace cascade {

inline double zero_like(double) { return 0; }

/// The axis that a call of `component` selects.
template <typename Graph>
std::size_t component_of(const Graph& nodes, const Node& call) {
    const Node& operand = nodes[call.operands[1]];
    const auto* const axis = operand.as<double>();
    CHECK(axis != nullptr, "which component is known");
    return static_cast<std::size_t>(*axis);
}

/// The result of a call, given the components of its operands. A number is stored as a vector of
/// which only x is used. Functions without a rule here, such as sums, work component by component:
/// apply(numbers) computes one component of the result from the same component of all operands.
template <typename Number, typename Graph, typename Apply>
BasicVector3<Number> of_components(const Graph& nodes, const Node& call,
                                   std::span<const BasicVector3<Number>> operands,
                                   const Apply& apply) {
    using Vector = BasicVector3<Number>;
    const Vector &a = operands.front(), &b = operands.back();
    switch (call.function) {
        case Function::vector:
            return {a.x, operands[1].x, operands.size() == 3 ? b.x : zero_like(a.x)};
        case Function::component: return Vector{a[component_of(nodes, call)]};
        case Function::dot: return Vector{dot(a, b)};
        case Function::cross: return cross(a, b);
        case Function::length: return Vector{length(a)};
        case Function::unit: return unit(a);
        default: break;
    }
    Vector result;
    for (std::size_t k = 0; k < (call.type == ValueType::vector ? 3 : 1); ++k) {
        std::array<Number, most_operands> numbers{};
        for (std::size_t n = 0; n < operands.size(); ++n) {
            const bool is_vector = nodes[call.operands[n]].type == ValueType::vector;
            numbers[n] = operands[n][is_vector ? k : 0];
        }
        result[k] = apply(numbers);
    }
    return result;
}

/// Whether vector_by() has a rule for calls of this function that return a vector.
inline bool makes_flux(Function function) {
    const FunctionInfo& row = info(function);
    const bool is_leaf = row.kind == FunctionKind::flux && row.result == ResultKind::vector;
    return is_leaf || row.kind == FunctionKind::arithmetic;
}

/// The result of a call that returns a vector of fields. `rules` compute gradients, components,
/// sums, and products of a vector with a number or a tensor.
template <typename Rules, typename Graph>
auto vector_by(Rules&& rules, const Graph& nodes, const Node& call) {
    const NodeId a = call.operands[0], b = call.reads().back();
    switch (call.function) {
        case Function::grad: return rules.gradient(a);
        case Function::vector: return rules.components(call.reads());
        case Function::negate: return rules.negative(a);
        case Function::add: return rules.sum(a, b);
        case Function::subtract: return rules.difference(a, b);
        case Function::divide: return rules.quotient(a, b);
        case Function::multiply: break;
        default: CHECK(false, "a vector of fields is made of gradients and components");
    }
    if (nodes[a].type == ValueType::tensor) return rules.turned(a, b);
    return rules.product(a, b, nodes[a].type == ValueType::vector);
}

}  // namespace cascade
