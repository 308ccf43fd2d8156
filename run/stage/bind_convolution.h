// Computes the weights of convolutions.
#pragma once

#include "run/stage/bound_kernel.h"
#include "solvers/convolution.h"

namespace cascade {

/// Computes the weights of a convolution from the present parameters. Each weight is multiplied by
/// the length, area or volume of a cell. A reach of NaN or below 0 counts as 0. There are at most
/// most_lags weights, because a stage with more weights is refused at its start.
WeightedLags weights_of(const Convolution& convolution, const BindingContext& context);

}  // namespace cascade
