// Evaluates functions of numbers that are known before the run.
#pragma once

#include "lang/program/program.h"

#include <array>
#include <optional>
#include <span>

namespace cascade {

/// The value of a function or operator of numbers; empty if the function cannot be evaluated before
/// the run (lap, random, …). `operands` must contain at least three numbers. If the function has
/// fewer operands, the last numbers are not used.
std::optional<double> fold(Function function, std::span<const double> operands);

/// A column of numbers for each operand. Each column is as long as the list of results. The first
/// three columns are always read. If a function has fewer than three operands, the other columns
/// may contain any numbers.
using OperandColumns = std::array<const double*, most_operands>;

/// For all k, sets values[k] to the result of the function for the k-th number of each column. If
/// the function cannot be evaluated, sets nothing and returns false.
bool fold(Function function, const OperandColumns& operands, std::span<double> values);

}  // namespace cascade
