// An estimate of the error of a step, for solvers that have none of their own.
#pragma once

#include "solvers/scheme.h"

namespace cascade {

/// The same step, followed by one more evaluation of the rates f that estimates its error as
///
///     e = h/2 · (f(old) + f(new)) − (new − old),
///
/// the difference from the trapezoidal rule through the two ends of the step. For Euler's method
/// this is h/2 · (f(new) − f(old)), the leading term of its error. In general e is proportional to
/// h² for methods of first order and to h³ for all others, of whose error it is an upper estimate
/// once steps are short. E. Hairer, S. P. Nørsett, G. Wanner, "Solving Ordinary Differential
/// Equations I", 1993, section II.4, treats such pairs.
///
/// For `imex2`, which is the trapezoidal rule itself where nothing diffuses, e is new − (old + h
/// k₁) instead, the difference from the solution of first order that the step computes on its way
/// (Verwer et al. 1999, section 2).
///
/// Rates at `new` are the first ones of the next step, so that a step costs one evaluation more.
/// Needs three registers more. (`imex2`: no evaluation, one register.) Where a value is frozen or
/// held at a bound, e is 0.
Scheme with_error_estimate(Scheme scheme);

}  // namespace cascade
