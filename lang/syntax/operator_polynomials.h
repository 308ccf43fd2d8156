// Polynomials of the Laplacian applied to a species: (1 + lap)^2 u, as Swift and Hohenberg's
// equation is printed.
//
// An operator is a `lap` without brackets, a sum that contains an operator, a product that ends
// with one, or a power or quotient of one. The product of an operator and a value is the operator
// applied to it, (a + b) u = a u + b u and (a * b) u = a (b u), with powers as products. lap(u)
// occurs once for each lap of the text, whatever the powers.
#pragma once

#include "lang/syntax/ast.h"

namespace cascade {

/// Whether the node is an operator.
bool is_operator(const ast::Script& script, ast::ExprId node);

/// Whether it is an operator that a product applies to its next factor. A bare `lap` is not.
bool applies_operator(const ast::Script& script, ast::ExprId node);

/// The largest power of an operator.
inline constexpr int most_operator_power = 8;

}  // namespace cascade
