// Adds error estimates to solvers that have none.
#pragma once

#include "solvers/scheme.h"

namespace cascade {

/// The given scheme, followed by an evaluation of the rates f that estimates the step's error as
///
///     e = h/2 · (f(old) + f(new)) − (new − old),
///
/// the difference from the trapezoidal rule through the two ends of the step. For Euler's method
/// this is h/2 · (f(new) − f(old)), the leading term of its error. In general e is proportional to
/// h² for methods of first order and to h³ for all other methods. For short steps, e is at least as
/// large as the error. E. Hairer, S. P. Nørsett, G. Wanner, "Solving Ordinary Differential
/// Equations I", 1993, section II.4, treats such pairs.
///
/// This estimate is useless for `etdrk4` on fine grids, where f amplifies the rounding errors of
/// `new`. For `etdrk4`, e is the difference from a method of second order that the last stage
/// computes (solvers/etd_stages.h), with waves damped as in the step. The estimate is also useless
/// for `ros2`, where f amplifies the errors of fast reactions. For `ros2`, solvers/rosenbrock.h
/// defines e.
///
/// The rates at `new` are the first rates of the next step, which reuses them. So the estimate
/// costs a sweep, but no further evaluation of the rates, and three more registers (only one for
/// `etdrk4` and `ros2`). e is 0 where a value is frozen or held at a bound.
Scheme with_error_estimate(Scheme scheme);

}  // namespace cascade
