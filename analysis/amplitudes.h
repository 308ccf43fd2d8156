// The patterns that grow at the onset of standing waves: stripes or spots, smoothly or by a jump.
//
// Near the onset a pattern is a sum of waves of one length, each with a slowly varying amplitude.
// If the critical wave is φ exp(i k·x), the amplitudes of three waves at 120° to each other obey
// the equations
//
//     τ dA₁/dt = μ A₁ + v A₂* A₃* − g |A₁|² A₁ − h (|A₂|² + |A₃|²) A₁
//
// and two more equations with rotated indices (M. Cross and P. Hohenberg, "Pattern formation
// outside of equilibrium", Reviews of Modern Physics 65, 1993, section IV; S. Ciliberto et al.,
// Physical Review Letters 65, 1990). Stripes have one amplitude, spots (hexagons) three equal ones.
#pragma once

#include "analysis/dispersion.h"

#include <optional>

namespace cascade::analysis {

/// The coefficients at an onset, per unit of time. The largest component of φ is 1.
struct AmplitudeEquations {
    Vector wave;           ///< The wave φ, with one component for each species.
    double quadratic = 0;  ///< The coefficient v. It is set to 0 if it is only a rounding error.
    double self =
        0;  ///< The coefficient g. If it is below 0, stripes begin by a jump: they are subcritical.
    /// The coefficient h. NaN on a line of cells, on which only stripes can form.
    double cross = 0;

    bool has_plane() const;
    /// Whether stripes are supercritical: beyond the onset, their amplitude grows smoothly from 0.
    bool is_supercritical() const { return self > 0; }
    /// Whether stripes replace spots farther from the onset. Unless v is 0, spots appear first, by
    /// a jump, before any stripes grow. If this function returns true, stripes replace the spots
    /// where the growth rate exceeds v² g / (h − g)².
    bool ends_in_stripes() const { return self > 0 && cross > self; }
    double rate_of_stripes() const;
};

/// The equations of a flat state at the onset of a standing wave. Empty in four cases: nonlinear
/// terms of the rates read other cells (products of derivatives, `lap(u^2)`, means, constraints);
/// the growth of waves depends on their direction; a uniform change does not fade, because a total
/// is conserved; or the wave is not critical.
std::optional<AmplitudeEquations> amplitude_equations(const LocalRates& rates, const Vector& state,
                                                      const Dispersion& relation);

}  // namespace cascade::analysis
