// Constant folding: functions of numbers that are known before the run.
#pragma once

#include "lang/program/program.h"

#include <optional>
#include <span>

namespace cascade {

/// The value of a function or operator of numbers; nothing if it has none (lap, random, …). There
/// are at least three numbers, of which the first are the operands.
std::optional<double> fold(Function function, std::span<const double> operands);

}  // namespace cascade
