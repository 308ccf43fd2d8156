// Error estimates for the steps of solvers that have none of their own.
#pragma once

#include "solvers/scheme.h"

namespace cascade {

/// The same step, followed by an evaluation of the rates f that estimates its error as
///
///     e = h/2 · (f(old) + f(new)) − (new − old),
///
/// the difference from the trapezoidal rule through the two ends of the step. For Euler's method
/// this is h/2 · (f(new) − f(old)), the leading term of its error. In general e is proportional to
/// h² for methods of first order and to h³ for all others. For short steps it is an upper estimate
/// of their error. E. Hairer, S. P. Nørsett, G. Wanner, "Solving Ordinary Differential Equations
/// I", 1993, section II.4, treats such pairs.
///
/// This estimate is useless for `etdrk4` on fine grids, where f amplifies the rounding errors of
/// `new`. Its e is the difference from a method of second order that the last stage knows
/// (solvers/etd_stages.h), with waves damped as in the step. The estimate is also useless for
/// `ros2`, where f amplifies the errors of fast reactions. Its e is defined in
/// solvers/rosenbrock.h.
///
/// The rates at `new` are the first rates of the next step, which reuses them. So the estimate
/// costs a sweep without an evaluation, and three more registers (`etdrk4` and `ros2`: one). e is 0
/// where a value is frozen or held at a bound.
Scheme with_error_estimate(Scheme scheme);

}  // namespace cascade
