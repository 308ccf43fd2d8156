// Evaluates formulas at places in binary64 while a script is prepared: shapes of surfaces and other
// values that must be more exact than those of cells.
#pragma once

#include "lang/program/fold.h"
#include "lang/program/program.h"

#include <array>
#include <functional>
#include <span>

namespace cascade {

/// Sets the values of a node that is neither a number nor a function of numbers, at several places:
/// values[k] at place k, where its operands have the k-th numbers of their columns. Returns false
/// for all other nodes.
using KnownValues = std::function<bool(const Node&, const OperandColumns&, std::span<double>)>;

/// Sets values[k] to the value of a formula at place k: of numbers, known values and functions of
/// numbers. Node by node, each at all places; some hundred places at a time stay in the caches.
void evaluate(const Formula& formula, const KnownValues& known, std::span<double> values);

/// Values of the built-in names, by Builtin.
using BuiltinValues = std::array<double, builtin_count>;

/// The value of a formula of numbers, built-in values and functions of numbers. The checker admits
/// nothing else in such formulas (checking::Context::position).
double evaluate(const Formula& formula, const BuiltinValues& builtins);

}  // namespace cascade
