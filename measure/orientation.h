// The direction of stripes, from the structure tensor.
#pragma once

#include "measure/samples.h"

namespace cascade::measure {

/// Which way a pattern runs in the plane of x and y.
struct Orientation {
    /// Along the stripes, in degrees from the x axis towards the y axis, [0, 180). y runs downwards
    /// in pictures, so that 45 is a line from the upper left to the lower right.
    double angle = 0;
    /// 0 where no direction is preferred, 1 for straight parallel stripes.
    double anisotropy = 0;
};

/// With J = ⟨∇f ∇fᵀ⟩, the mean over all cells (of central differences), the gradient's direction is
/// φ = ½ atan2(2 Jxy, Jxx − Jyy); stripes run across it. The anisotropy is the coherence
/// √((Jxx − Jyy)² + 4 Jxy²) / (Jxx + Jyy). J. Bigün and G. H. Granlund, "Optimal orientation
/// detection of linear symmetry", ICCV 1987. NaN both where nothing varies or on a line of cells.
Orientation orientation_of(const Samples& samples);

}  // namespace cascade::measure
