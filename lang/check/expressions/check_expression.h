// Checks one expression (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// A checked expression, and its value if it consists only of numbers.
struct CheckedExpression {
    Formula formula;
    std::optional<double> constant;

    ValueType type() const { return formula.nodes.back().type; }
};

/// Checks an expression: resolves names, counts arguments, checks types and contexts, and finds
/// divisions by zero. Calls of the script's own functions, families and aggregates over an index
/// are expanded first. The formula's nodes are in the same order as the expression's nodes. Returns
/// nullopt if there was an error, which this function or the parser has reported.
std::optional<CheckedExpression> check_expression(Workspace& work, const ast::Script& script,
                                                  ast::Expression expression, const Scope& scope);

/// Checks an expression that has been expanded (expand.h) or needs no expansion.
std::optional<CheckedExpression> check_parts(Workspace& work, const ast::Script& script,
                                             ast::Expression expression, const Scope& scope);

/// Checks an expression that must be a number, not a colour, a vector or a string.
std::optional<CheckedExpression> check_number(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope);

/// Checks an expression that must be a vector.
std::optional<CheckedExpression> check_vector(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope);

/// How messages name a type, and a hint for a value of this type where a number is needed.
struct TypeWords {
    std::string_view name, hint;
};
TypeWords words_of(ValueType type, bool in_cells);
/// The hint for another value where a vector is needed.
constexpr const char* vectors_are(bool in_cells) {
    return in_cells ? "such as p, normal or vector(1, 0, 0)" : "such as grad(e) or vector(ex, ey)";
}

/// The largest depth to which operators may be nested. Each level of nesting needs a pass over the
/// grid.
inline constexpr std::uint32_t most_nested_operators = 32;

/// The depth to which operators in a formula are nested. `of_leaf` gives the depth of each leaf (a
/// definition, a rate or an item). Reports an error at the first operator that is nested too
/// deeply.
template <typename DepthOfLeaf>
std::uint32_t check_nesting(Workspace& work, const Formula& formula, const DepthOfLeaf& of_leaf);

/// The value of a constant expression, in double precision. Reports errors, in which `subject` is
/// the name of the constant. If the value has a unit, the dimension of the unit must be
/// `dimension`. If `dimension` is empty, any unit is allowed.
std::optional<double> check_constant(Workspace& work, const ast::Script& script,
                                     ast::Expression expression, std::string_view subject,
                                     std::optional<Dimension> dimension = Dimension{});

/// Whether the unit of a constant formula has this dimension. A formula without a unit is allowed.
/// Reports errors.
bool check_unit_of_constant(Workspace& work, const Formula& formula, std::string_view subject,
                            const Dimension& dimension);

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
