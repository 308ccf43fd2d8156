// Checking one expression (internal to the checker).
#pragma once

#include "lang/check/check_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// A checked expression, and its value where it is made of numbers alone.
struct CheckedExpression {
    Formula formula;
    std::optional<double> constant;

    ValueType type() const { return formula.nodes.back().type; }
};

/// Resolves names, counts arguments, checks types and places, and finds divisions by zero. Parts of
/// the formula are in the order of `expression`'s. Nothing is returned where there was a fault; it
/// has been reported then, here or by the parser. Calls of the script's own functions, families and
/// aggregates over an index are written out first.
std::optional<CheckedExpression> check_expression(Workspace& work, const ast::Script& script,
                                                  ast::Expression expression, const Scope& scope);

/// The same for an expression of which nothing needs to be written out any more (expand.h).
std::optional<CheckedExpression> check_parts(Workspace& work, const ast::Script& script,
                                             ast::Expression expression, const Scope& scope);

/// The same for an expression that must be a number (and no colour or text).
std::optional<CheckedExpression> check_number(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope);

/// How messages call a type that is no number, and what helps where a number is expected.
struct TypeWords {
    std::string_view name, hint;
};
TypeWords words_of(ValueType type);

/// Operators in operators take a pass over the grid for each layer: more than this many are an
/// error.
inline constexpr std::uint32_t most_nested_operators = 32;

/// How deep operators lie in each other in a formula, given that depth for its leaves
/// (definitions, rates, own items). Too deep is an error, said once.
template <typename DepthOfLeaf>
std::uint32_t check_nesting(Workspace& work, const Formula& formula, const DepthOfLeaf& of_leaf);

/// One number that is known now, in double precision: `subject` names it in messages.
std::optional<double> check_constant(Workspace& work, const ast::Script& script,
                                     ast::Expression expression, std::string_view subject);

template <typename DepthOfLeaf>
std::uint32_t check_nesting(Workspace& work, const Formula& formula, const DepthOfLeaf& of_leaf) {
    IdVector<NodeId, std::uint32_t> depth;
    depth.reserve(formula.nodes.size());
    for (const Node& node : formula.nodes) {
        std::uint32_t deepest = 0;
        if (node.kind == NodeKind::call) {
            for (const NodeId operand : node.reads()) {
                deepest = std::max(deepest, depth[operand]);
            }
            const bool adds = differentiates(node.function) || info(node.function).is_aggregate;
            if (adds && deepest++ == most_nested_operators) {
                work.diagnostics.error(node.span, "operators lie too deep in each other",
                                       fmt::format("at most {} may", most_nested_operators));
            }
        } else {
            deepest = of_leaf(node);
        }
        depth.push_back(deepest);
    }
    return depth.empty() ? 0 : depth.back();
}

}  // namespace cascade::checking
