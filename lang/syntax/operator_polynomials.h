// Polynomials of the Laplacian that are applied to a species:
// (1 + lap)^2 u, as Swift and Hohenberg's equation is printed.
//
// `lap` without brackets is an operator; so are a sum with an operator in it, a product that ends
// with one, and its powers and quotients. The product of an operator and a value is the operator
// applied to it, (a + b) u = a u + b u and (a * b) u = a (b u), with powers as products. lap(u)
// occurs once for each lap of the text, whatever the powers.
#pragma once

#include "lang/syntax/ast.h"

namespace cascade {

/// Is the node an operator?
bool is_operator(const ast::Script& script, ast::ExprId node);

/// Is it an operator that a product applies to what follows it? A bare `lap` is not.
bool applies_operator(const ast::Script& script, ast::ExprId node);

/// The largest power of an operator.
inline constexpr int most_operator_power = 8;

}  // namespace cascade
