// Evaluates functions of numbers that are known before the run.
#pragma once

#include "lang/program/program.h"

#include <array>
#include <optional>
#include <span>

namespace cascade {

/// The value of a function or operator of numbers; empty if the function cannot be evaluated before
/// the run (lap, random, …). `operands` must have at least three numbers, of which the first are
/// the operands.
std::optional<double> fold(Function function, std::span<const double> operands);

/// A column of numbers for each operand, as long as the results. The first three columns are always
/// read. If a function has fewer operands, the other columns may contain any numbers.
using OperandColumns = std::array<const double*, most_operands>;

/// For all k, sets values[k] to the function of the k-th numbers of the columns. Returns false, and
/// sets nothing, if the function cannot be evaluated.
bool fold(Function function, const OperandColumns& operands, std::span<double> values);

}  // namespace cascade
