// Checking one expression (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// A checked expression, and its value if it consists of numbers only.
struct CheckedExpression {
    Formula formula;
    std::optional<double> constant;

    ValueType type() const { return formula.nodes.back().type; }
};

/// Checks an expression: resolves names, counts arguments, checks types and contexts, and finds
/// divisions by zero. Nodes of the formula are in the order of the expression's. Returns nothing if
/// there was an error, which has then been reported here or by the parser. Calls of the script's
/// own functions, families and aggregates over an index are expanded first.
std::optional<CheckedExpression> check_expression(Workspace& work, const ast::Script& script,
                                                  ast::Expression expression, const Scope& scope);

/// The same for an expression in which nothing is left to expand (expand.h).
std::optional<CheckedExpression> check_parts(Workspace& work, const ast::Script& script,
                                             ast::Expression expression, const Scope& scope);

/// The same for an expression that must be a number, not a colour or a string.
std::optional<CheckedExpression> check_number(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope);

/// The same for an expression that must be a vector.
std::optional<CheckedExpression> check_vector(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope);

/// The name of a type in messages, and a hint where a number is expected instead.
struct TypeWords {
    std::string_view name, hint;
};
TypeWords words_of(ValueType type, bool in_cells);
/// The hint where a vector is expected.
constexpr const char* vectors_are(bool in_cells) {
    return in_cells ? "such as p, normal or vector(1, 0, 0)" : "such as grad(e) or vector(ex, ey)";
}

/// The most levels of nested operators; each level takes a pass over the grid.
inline constexpr std::uint32_t most_nested_operators = 32;

/// The nesting depth of the operators in a formula; `of_leaf` gives the depth of its leaves
/// (definitions, rates, own items). Reports an error where the limit is first exceeded.
template <typename DepthOfLeaf>
std::uint32_t check_nesting(Workspace& work, const Formula& formula, const DepthOfLeaf& of_leaf);

/// A constant in double precision; reports errors, in which `subject` names it.
std::optional<double> check_constant(Workspace& work, const ast::Script& script,
                                     ast::Expression expression, std::string_view subject);

template <typename DepthOfLeaf>
std::uint32_t check_nesting(Workspace& work, const Formula& formula, const DepthOfLeaf& of_leaf) {
    IdVector<NodeId, std::uint32_t> depth;
    depth.reserve(formula.nodes.size());
    for (const Node& node : formula.nodes) {
        std::uint32_t deepest = 0;
        if (node.is<Call>()) {
            for (const NodeId operand : node.reads()) {
                deepest = std::max(deepest, depth[operand]);
            }
            const bool adds = differentiates(node.function) || is_over_neighbours(node.function) ||
                              info(node.function).is_aggregate;
            if (adds && deepest++ == most_nested_operators) {
                work.diagnostics.error(node.span, "operators are nested too deeply",
                                       fmt::format("at most {} levels", most_nested_operators));
            }
        } else {
            deepest = of_leaf(node);
        }
        depth.push_back(deepest);
    }
    return depth.empty() ? 0 : depth.back();
}

}  // namespace cascade::checking
