// Evaluates formulas at positions, in binary64, while a script is prepared. Used for shapes of
// surfaces and for other values that must be more exact than the values of cells.
#pragma once

#include "lang/program/fold.h"
#include "lang/program/program.h"

#include <array>
#include <functional>
#include <span>

namespace cascade {

/// Evaluates nodes that are neither numbers nor functions of numbers, such as coordinates. Sets
/// values[k] to the node's value at position k and returns true, or returns false if this node has
/// no known value. The k-th number of each column is the value of an operand at position k.
using KnownValues = std::function<bool(const Node&, const OperandColumns&, std::span<double>)>;

/// Sets values[k] to the value of a formula at position k. The formula may consist of numbers,
/// known values and functions of numbers. Computes one node after another, each at all positions,
/// so callers should pass only some hundred positions at a time, which fit into the caches.
void evaluate(const Formula& formula, const KnownValues& known, std::span<double> values);

/// Values of the built-in names, indexed by Builtin.
using BuiltinValues = std::array<double, builtin_count>;

/// The value of a formula of numbers, built-in values and functions of numbers. The checker allows
/// nothing else in such formulas (checking::Context::position).
double evaluate(const Formula& formula, const BuiltinValues& builtins);

}  // namespace cascade
