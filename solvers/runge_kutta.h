// Explicit Runge-Kutta methods, made from their Butcher tableaux (internal to solvers/).
#pragma once

#include "solvers/scheme.h"

#include <vector>

namespace cascade {

/// Stage i is evaluated at old + step · Σ a[i][j] k_j, at the time step · Σ a[i][j]. The new step
/// is old + step · Σ b[j] k_j.
struct ButcherTableau {
    std::vector<std::vector<double>> a;  ///< Row i has i entries.
    std::vector<double> b;
    /// The error is step · Σ error[j] k_j. This sum has one term more than the sum with `b`: the
    /// last k is the rate at the new step. Empty if the method has no estimate.
    std::vector<double> error;
    /// The factors of Scheme::curve, in the order of the rates in `error`. May be empty.
    std::vector<double> curve = {};
};

/// The midpoint rule.
ButcherTableau midpoint();
/// The classical method of order 4 (W. Kutta, 1901).
ButcherTableau classical();
/// P. Bogacki, L. F. Shampine, "A 3(2) pair of Runge-Kutta formulas", Applied Mathematics Letters
/// 2, 1989, 321-325.
ButcherTableau bogacki_shampine();
/// J. R. Dormand, P. J. Prince, "A family of embedded Runge-Kutta formulae", Journal of
/// Computational and Applied Mathematics 6, 1980, 19-26. The curve is the method's continuous
/// extension of order 4: E. Hairer, S. P. Nørsett, G. Wanner, "Solving Ordinary Differential
/// Equations I", second edition, Springer 1993, section II.6, as in their program DOPRI5.
ButcherTableau dormand_prince();

/// Builds the scheme of a tableau: one sweep for each stage, and one for the error.
Scheme explicit_runge_kutta(const ButcherTableau& tableau);

}  // namespace cascade
