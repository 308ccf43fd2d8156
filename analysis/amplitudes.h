// The patterns that grow at the onset of standing waves: stripes or spots, smoothly or by a jump.
//
// Near the onset a pattern is a sum of waves of one length, each with a slowly varying amplitude.
// With the critical wave φ exp(i k·x), three waves at 120° to each other have the equations
//
//     τ dA₁/dt = μ A₁ + v A₂* A₃* − g |A₁|² A₁ − h (|A₂|² + |A₃|²) A₁
//
// and two more by rotation (M. Cross and P. Hohenberg, "Pattern formation outside of equilibrium",
// Reviews of Modern Physics 65, 1993, section IV; S. Ciliberto et al., Physical Review Letters 65,
// 1990). Stripes have one amplitude, spots (hexagons) three equal ones.
#pragma once

#include "analysis/dispersion.h"

#include <optional>

namespace cascade::analysis {

/// The coefficients at an onset, per unit of time. The largest component of φ is 1.
struct AmplitudeEquations {
    Vector wave;           ///< φ, by species.
    double quadratic = 0;  ///< v. 0 if it is a rounding error.
    double self = 0;       ///< g. Below 0, stripes begin by a jump: they are subcritical.
    double cross = 0;      ///< h. NaN in a row of cells, which has stripes only.

    bool has_plane() const;
    /// Whether stripes grow smoothly from 0.
    bool is_supercritical() const { return self > 0; }
    /// Spots begin by a jump wherever v is not 0, before any stripes grow. If this is true, stripes
    /// replace them farther from the onset, from the growth rate v² g / (h − g)² on.
    bool ends_in_stripes() const { return self > 0 && cross > self; }
    double rate_of_stripes() const;
};

/// The equations of a flat state at the onset of a standing wave. Empty if the nonlinearities of
/// the rates reach other cells (products of derivatives, `lap(u^2)`, means, constraints), if waves
/// depend on their direction, if a uniform change does not fade (a total is conserved), or if the
/// wave is not critical.
std::optional<AmplitudeEquations> amplitude_equations(const LocalRates& rates, const Vector& state,
                                                      const Dispersion& relation);

}  // namespace cascade::analysis
