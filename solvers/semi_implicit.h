// Schemes that take diffusion implicitly or exactly, by filtering waves (internal to solvers/).
//
// All compute the change in a step, not the new values. With L the diffusion and N the rest of the
// rate, implicit Euler for L and explicit Euler for N, new = old + h (L new + N old), is the same
// as
//
//     new = old + (1 − h L)⁻¹ h f(old),    f = L + N being the whole rate.
//
// So only the whole rate is computed, as the user wrote it. A state whose rates are 0 does not
// change, and fixed values at sides cancel out. If L is not exactly the diffusion, a step is less
// accurate, but the limit of short steps is the same.
#pragma once

#include "solvers/scheme.h"

namespace cascade {

/// new = old + h R f(old), where R is the response of each wave. With the response `implicit`, this
/// is semi-implicit Euler. With `exponential`, it is Euler's exponential method, which is exact if
/// the rate is diffusion alone (S. M. Cox, P. C. Matthews, "Exponential time differencing for stiff
/// systems", Journal of Computational Physics 176, 2002, 430-455, equation 4).
Scheme one_filter(WaveResponse response);

/// The exponential method of fourth order in solvers/etd_stages.h.
Scheme etdrk4();

}  // namespace cascade
