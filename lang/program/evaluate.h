// Evaluates formulas at one place in binary64 while a script is prepared: shapes of surfaces and
// other values that must be more exact than those of cells.
#pragma once

#include "lang/program/program.h"

#include <array>
#include <functional>
#include <optional>

namespace cascade {

/// Values of the built-in names, by Builtin.
using BuiltinValues = std::array<double, builtin_count>;

/// The value of a formula of numbers, built-in values and functions of numbers. The checker admits
/// nothing else in such formulas (checking::Context::position).
double evaluate(const Formula& formula, const BuiltinValues& builtins);

/// The values of nodes that are neither numbers nor functions of numbers, given the values of their
/// operands; nothing for all others.
using KnownValue =
    std::function<std::optional<double>(const Node&, const std::array<double, most_operands>&)>;

/// The value of a formula of numbers, known values and functions of numbers.
double evaluate(const Formula& formula, const KnownValue& known);

}  // namespace cascade
