// A Rosenbrock method, implicit in the reaction of each cell (internal to solvers/).
#pragma once

#include "solvers/scheme.h"

namespace cascade {

/// ROS2 by J. G. Verwer, E. J. Spee, J. G. Blom, W. Hundsdorfer, "A second-order Rosenbrock method
/// applied to photochemical dispersion problems", SIAM Journal on Scientific Computing 20, 1999,
/// 1456-1480, with f the rates, h the step and γ = 1 − 1/√2:
///
///     (1 − γ h J) k1 = f(old)
///     (1 − γ h J) k2 = f(old + h k1) − 2 k1
///     new = old + h (3/2 k1 + 1/2 k2)
///
/// The method is of second order for any matrix J (a W-method), and L-stable for the part of the
/// rates whose derivatives are in J. Here J has the derivatives within each cell, so that the
/// equations of cells are independent and diffusion is explicit, as in Heun's method. As in H. H.
/// Rosenbrock's own methods (The Computer Journal 5, 1963), J is evaluated at old for k1 and at old
/// + h k1 for k2. The two matrices differ by a term of order h, which does not affect the method's
/// order. J shares subexpressions with the rates at the same point.
Scheme ros2();

/// ros2() with an estimate of its error: h/2 (k1 + k2), which is the difference between the new
/// step and old + h k1, a step of first order.
Scheme with_embedded_error(Scheme scheme);

}  // namespace cascade
