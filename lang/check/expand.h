// Writing out what stands for more than it is (internal to the checker): calls of the script's own
// functions, members of families, and aggregates over an index.
//
//     sum(bump(u[i], 2) over i)   with   fn bump(r, w) = exp(-(r/w)^2)   and   i: 1..2
//
// becomes exp(-(u[1]/2)^2) + exp(-(u[2]/2)^2), with names u[1] and u[2]. An argument is one part of
// the new expression, however often the function reads it: so it is computed once, and a random
// number in it is one draw.
#pragma once

#include "lang/check/check_names.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace cascade::checking {

/// An expression that was written out. Operands still come before operators, but a part may be read
/// by several others, or by none.
struct Expanded {
    ast::Script parts;  ///< Expressions and arguments only.
    ast::ExprId root = 0;
    std::deque<std::string> names;           ///< Of members; the parts' names are views of them.
    std::vector<std::optional<Span>> calls;  ///< By part: the call that it was written out for.
};

/// Is there anything to be written out?
bool needs_expansion(Workspace& work, const ast::Script& script, ast::Expression expression,
                     const Scope& scope);

/// Writes an expression out. Faults are told, and Garbage stands in their places. Together the
/// expressions of a check may become so large and no larger: the message names the first one that
/// is too much.
Expanded expand(Workspace& work, const ast::Script& script, ast::Expression expression,
                const Scope& scope);

/// The index of this name of a scope's system; null where it has none.
const Index* find_index(const Workspace& work, const Scope& scope, std::string_view name);

/// "u[2]"
std::string member_name(std::string_view family, std::int64_t index);

}  // namespace cascade::checking
