// Constant folding: functions of numbers that are known before the run.
#pragma once

#include "lang/program/program.h"

#include <array>
#include <optional>
#include <span>

namespace cascade {

/// The value of a function or operator of numbers; nothing if it has none (lap, random, …). There
/// are at least three numbers, of which the first are the operands.
std::optional<double> fold(Function function, std::span<const double> operands);

/// A column of numbers for each operand, as long as the results. The first three are read in any
/// case; where a function has fewer operands, the others may be any columns.
using OperandColumns = std::array<const double*, most_operands>;

/// Sets values[k] to the function of the k-th numbers, for all k. Returns false, and sets nothing,
/// if the function has no value.
bool fold(Function function, const OperandColumns& operands, std::span<double> values);

}  // namespace cascade
