// Typesets an expression (internal to printing equations).
#pragma once

#include "core/source.h"
#include "lang/equations/equation_symbols.h"
#include "lang/syntax/ast.h"

#include <string>

namespace cascade {

/// Precedences in the grammar: 1 `or`, 2 `and`, 3 `not`, 4 comparisons, 5 sums, 6 products, 7
/// signs, 8 powers, 9 names and brackets.
inline constexpr int anything = 0, a_sum = 5, a_product = 6;

/// Typesets the expression. Puts it in brackets if its precedence is below `least`.
std::string typeset(const ast::Script& script, const Sources& sources, const Symbols& symbols,
                    ast::ExprId root, int least);

}  // namespace cascade
