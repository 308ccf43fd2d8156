// Functions that are linear in some of their operands, for constraints.
#pragma once

#include "lang/program/program.h"

#include <cstddef>

namespace cascade {

/// Is a call linear in operand `k` while its other operands stay?
bool is_linear_in(const Node& call, std::size_t k);

/// Is the function linear in all its linear operands together, as a sum is and a product is not?
bool is_jointly_linear(Function function);

}  // namespace cascade
