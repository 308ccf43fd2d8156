// The weights of convolutions.
#pragma once

#include "run/stage/bound_kernel.h"
#include "solvers/convolution.h"

namespace cascade {

/// Computes the weights of a convolution from the present parameters, each times the length, area
/// or volume of a cell. A reach of NaN or below 0 counts as 0. Throws std::bad_alloc if there would
/// be more than most_lags.
WeightedLags weights_of(const Convolution& convolution, const BindingContext& context);

}  // namespace cascade
