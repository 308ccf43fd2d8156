// Evaluates formulas at positions, in binary64, while a script is prepared. Used for shapes of
// surfaces and for other values that must be more exact than the values of cells.
#pragma once

#include "lang/program/fold.h"
#include "lang/program/program.h"

#include <array>
#include <functional>
#include <span>

namespace cascade {

/// Evaluates a node that is neither a number nor a function of numbers, such as a coordinate. Sets
/// values[k] to the node's value at position k and returns true. If the value of the node is not
/// known, returns false. The k-th number of each operand's column is the operand's value at
/// position k.
using KnownValues = std::function<bool(const Node&, const OperandColumns&, std::span<double>)>;

/// Sets values[k] to the value of a formula at position k. The formula may consist of numbers,
/// known values and functions of numbers. The nodes are computed one after another, each at all
/// positions. So callers should pass only a few hundred positions at a time, whose values fit into
/// the caches.
void evaluate(const Formula& formula, const KnownValues& known, std::span<double> values);

/// The values of the built-in names, indexed by Builtin.
using BuiltinValues = std::array<double, builtin_count>;

/// The value of a formula of numbers, built-in values and functions of numbers. The checker allows
/// nothing else in these formulas (checking::Context::position).
double evaluate(const Formula& formula, const BuiltinValues& builtins);

}  // namespace cascade
