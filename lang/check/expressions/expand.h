// Expands calls of the script's own functions, members of families, and aggregates over an index
// (internal to the checker).
//
//     sum(bump(u[i], 2) over i)   with   fn bump(r, w) = exp(-(r/w)^2)   and   i: 1..2
//
// becomes exp(-(u[1]/2)^2) + exp(-(u[2]/2)^2), with names u[1] and u[2]. An argument becomes one
// node of the new expression, however often the function reads the argument. So the argument is
// computed once, and a random number in it is drawn once.
#pragma once

#include "lang/check/names/check_names.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace cascade::checking {

/// An expanded expression. As in every expression, operands come before their operators. In
/// contrast to other expressions, a node may be the operand of several nodes or of no node.
struct Expanded {
    ast::Script parts;  ///< A script with nothing but expressions and arguments.
    ast::ExprId root = 0;
    /// The names of members. The nodes contain views of these names.
    std::deque<std::string> names;
    /// For each node, the call from which it was expanded.
    std::vector<std::optional<Span>> calls;
};

/// Whether the expression contains calls, members or aggregates that must be expanded.
bool needs_expansion(Workspace& work, const ast::Script& script, ast::Expression expression,
                     const Scope& scope);

/// Expands an expression. Reports errors, and replaces each wrong part by Garbage. The total size
/// of all expansions in a check is limited, and the first expression that exceeds the limit is
/// reported.
Expanded expand(Workspace& work, const ast::Script& script, ast::Expression expression,
                const Scope& scope);

/// The index of this name in the scope's system; null if there is none.
const Index* find_index(const Workspace& work, const Scope& scope, std::string_view name);

/// The name of a member, such as "u[2]" or "A[1,2]".
std::string member_name(std::string_view family, const std::vector<std::int64_t>& indices);

}  // namespace cascade::checking
