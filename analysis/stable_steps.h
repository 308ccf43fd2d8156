// The longest steps with which explicit solvers let every wave fade that fades.
#pragma once

#include "analysis/wave_operators.h"
#include "ir/solver.h"

#include <span>
#include <vector>

namespace cascade::analysis {

struct StableStep {
    Solver solver = Solver::euler;
    double step = 0;  ///< In the time of the rates; infinite if nothing fades; 0 if no step is.
};

/// For euler, rk2, rk4, rk23 and rk45, by the polynomial with which each multiplies a wave in a
/// step (E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 1996, section IV.2).
/// `rates` are eigenvalues whose real part is not above 0.
std::vector<StableStep> stable_steps(std::span<const Complex> rates);

}  // namespace cascade::analysis
