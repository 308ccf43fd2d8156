// Expansion (internal to the checker) of calls of the script's own functions, members of families,
// and aggregates over an index.
//
//     sum(bump(u[i], 2) over i)   with   fn bump(r, w) = exp(-(r/w)^2)   and   i: 1..2
//
// becomes exp(-(u[1]/2)^2) + exp(-(u[2]/2)^2), with names u[1] and u[2]. An argument becomes one
// node of the new expression however often the function reads it, so it is computed once, and a
// random number in it is drawn once.
#pragma once

#include "lang/check/names/check_names.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace cascade::checking {

/// An expanded expression. Operands still come before operators, but a node may have several users,
/// or none.
struct Expanded {
    ast::Script parts;  ///< Expressions and arguments only.
    ast::ExprId root = 0;
    std::deque<std::string> names;           ///< Names of members; nodes refer to them by views.
    std::vector<std::optional<Span>> calls;  ///< By node: the call that it was expanded from.
};

/// True if there is anything to expand.
bool needs_expansion(Workspace& work, const ast::Script& script, ast::Expression expression,
                     const Scope& scope);

/// Expands an expression. Errors are reported, and Garbage stands in their places. The total size
/// of the expansions in a check is limited; the first expression beyond the limit is reported.
Expanded expand(Workspace& work, const ast::Script& script, ast::Expression expression,
                const Scope& scope);

/// The index of this name of a scope's system; null if there is none.
const Index* find_index(const Workspace& work, const Scope& scope, std::string_view name);

/// "u[2]", "A[1,2]"
std::string member_name(std::string_view family, const std::vector<std::int64_t>& indices);

}  // namespace cascade::checking
