// The rules of calculus for single calls (internal to derivative.cpp).
#pragma once

#include "lang/calculus/algebra.h"

#include <cstddef>
#include <optional>

namespace cascade {

/// The derivative of the call with respect to its operand n. nullopt if there is no rule for the
/// function. Rules for operators of derivatives are in lang/calculus/slopes.h.
std::optional<NodeId> partial_derivative(Algebra& algebra, const Node& call, std::size_t n);

}  // namespace cascade
