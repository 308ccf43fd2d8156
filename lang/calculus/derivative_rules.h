// The rules of calculus, one call at a time (internal to derivative.cpp).
#pragma once

#include "lang/calculus/algebra.h"

#include <cstddef>
#include <optional>

namespace cascade {

/// ∂(the call)/∂(its operand n), if its function has a rule for it. Operators of derivatives have
/// none here: see lang/calculus/slopes.h.
std::optional<NodeId> partial_derivative(Algebra& algebra, const Node& call, std::size_t n);

}  // namespace cascade
