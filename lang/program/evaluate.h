// Formulas evaluated at one place in binary64, while a script is prepared: shapes of surfaces and
// whatever else is needed more exactly than cells compute it.
#pragma once

#include "lang/program/program.h"

#include <array>

namespace cascade {

/// Values of the built-in names, by Builtin.
using BuiltinValues = std::array<double, builtin_count>;

/// The value of a formula of numbers, built-in values and functions of numbers; the checker lets
/// nothing else into such formulas (checking::Context::position).
double evaluate(const Formula& formula, const BuiltinValues& builtins);

}  // namespace cascade
