// Schemes that take diffusion implicitly or exactly, by filtering waves (internal to solvers/).
//
// All are written for the change of a step instead of the new values. With L the diffusion and N
// the rest, implicit Euler for L and explicit Euler for N, new = old + h (L new + N old), is the
// same as
//
//     new = old + (1 − h L)⁻¹ h f(old),    f = L + N being the whole rate.
//
// So only the rate is computed, as the user wrote it. A state whose rates are 0 does not change,
// and values held at sides drop out. If L is not exactly the diffusion, this costs some accuracy
// but does not change the limit of short steps.
#pragma once

#include "solvers/scheme.h"

namespace cascade {

/// new = old + h R f(old), R being the response of each wave. Implicit: semi-implicit Euler.
/// Exponential: Euler's exponential method, which is exact where the rate is diffusion alone (S. M.
/// Cox, P. C. Matthews, "Exponential time differencing for stiff systems", Journal of Computational
/// Physics 176, 2002, 430-455, equation 4).
Scheme one_filter(WaveResponse response);

/// The exponential method of fourth order in solvers/etd_stages.h.
Scheme etdrk4();

}  // namespace cascade
