// The direction of stripes, from the structure tensor.
#pragma once

#include "measure/samples.h"

namespace cascade::measure {

/// The direction of a pattern in the plane of x and y.
struct Orientation {
    /// The direction of the stripes, in degrees from the x axis towards the y axis, [0, 180). y
    /// points down in pictures, so 45 is a line from the upper left to the lower right.
    double angle = 0;
    /// 0 without a preferred direction, 1 for straight parallel stripes.
    double anisotropy = 0;
};

/// With J = ⟨∇f ∇fᵀ⟩, the mean over all cells (of central differences of sixth order), the gradient
/// has the direction φ = ½ atan2(2 Jxy, Jxx − Jyy), perpendicular to the stripes. The anisotropy is
/// the coherence √((Jxx − Jyy)² + 4 Jxy²) / (Jxx + Jyy). J. Bigün and G. H. Granlund, "Optimal
/// orientation detection of linear symmetry", ICCV 1987. Both are NaN for even fields and
/// one-dimensional grids.
Orientation orientation_of(const Samples& samples);

}  // namespace cascade::measure
