// The stages of etdrk4, wave by wave (internal to solvers/).
#pragma once

#include "ir/sweep_form.h"
#include "solvers/wave_damping.h"

#include <array>
#include <vector>

namespace cascade {

/// The numbers that a step stores for each wave between stages: the rate at the old step, two
/// differences from it, and φ₁, φ₂, φ₃ of half a step.
template <typename Number>
using EtdMemory = std::array<Number*, etd_registers>;

/// Takes stage `response` of the exponential Runge-Kutta method of fourth order by S. Krogstad
/// ("Generalized integrating factor methods for stiff PDEs", Journal of Computational Physics 203,
/// 2005, 72-88), written in terms of changes instead of values. With L the diffusion, z = h L, and
/// D_i = f(U_i) − f(old) − L (U_i − old) the change of the rest of the rates,
///
///     U₂  = old + h/2 φ₁(z/2) f(old),                  U₃ = U₂ + h φ₂(z/2) D₂,
///     U₄  = old + h (φ₁(z) f(old) + 2 φ₂(z) D₃),
///     new = old + h (φ₁(z) f(old) + (2 φ₂(z) − 4 φ₃(z)) (D₂ + D₃) + (4 φ₃(z) − φ₂(z)) D₄).
///
/// The stage reads the waves of f at the last point in waves[0] of the block and replaces them by
/// the waves of (next point − old) / h. The last stage also writes the waves of (new − U₄) / h to
/// waves[1], if present. U₄ is the step of a method of second order, the exponential midpoint rule.
/// `f` is the diffusion's symbol times h. `damping` is scratch memory.
template <typename Number>
void take_etd_stage(const WaveBlock<Number>& block, const DiffusionTerms<Number>& f,
                    WaveResponse response, const EtdMemory<Number>& memory,
                    std::vector<Number>& damping);

}  // namespace cascade
