// Constant folding: functions of numbers that are known while a script is prepared.
#pragma once

#include "lang/program/program.h"

#include <optional>
#include <span>

namespace cascade {

/// The value of a function or operator of numbers; nothing where it has none (lap, random, …).
/// There are at least three numbers, the first of which are the operands.
std::optional<double> fold(Function function, std::span<const double> operands);

}  // namespace cascade
