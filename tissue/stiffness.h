// Estimates the largest eigenvalue of the Jacobian of a tissue's rates, which determines the number
// of stages of a stabilised solver.
#pragma once

#include "tissue/tissue.h"
#include "tissue/value_runner.h"

#include <span>

namespace cascade {

/// The magnitude of the largest eigenvalue, in 1 / time, estimated by power iteration with forward
/// differences of the rates, plus a tenth (B. Sommeijer, L. Shampine, J. Verwer, "RKC: an explicit
/// solver for parabolic PDEs", Journal of Computational and Applied Mathematics 88, 1998,
/// section 2.2). The iteration begins with the direction in tissue.stiffest and stores its last
/// direction there. `scales` are the sizes of the species, above 0. Sums are in the order of the
/// cells' numbers. Returns 0 if rates are not finite.
double estimate_stiffness(Tissue& tissue, const CellValues& rates, std::span<const double> scales,
                          const StepMoment& moment, ValueRunner& runner);

}  // namespace cascade
