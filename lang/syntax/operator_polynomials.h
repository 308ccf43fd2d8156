// Polynomials of the Laplacian that are applied to a species, such as (1 + lap)^2 u, as papers
// print Swift and Hohenberg's equation.
//
// An operator is a `lap` without brackets, a sum that contains an operator, a product that ends
// with an operator, or a power or quotient of an operator. Multiplying a value by an operator
// applies the operator to it: (a + b) u = a u + b u and (a * b) u = a (b u). A power is treated as
// a product of equal factors.
#pragma once

#include "lang/syntax/ast.h"

namespace cascade {

/// Whether the node is an operator.
bool is_operator(const ast::Script& script, ast::ExprId node);

/// Whether the node is an operator that is applied to the next factor if it is a factor of a
/// product. A `lap` that stands alone is not applied in this way.
bool applies_operator(const ast::Script& script, ast::ExprId node);

/// The largest power to which an operator may be raised.
inline constexpr int most_operator_power = 8;

}  // namespace cascade
