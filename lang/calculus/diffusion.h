// What of each rate is diffusion of its own species: what semi-implicit solvers take implicitly.
#pragma once

#include "ir/diffusion.h"
#include "lang/program/program.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// A formula for each factor of a species' diffusion; without nodes where it is 0. The largest
/// value over the cells is what counts.
using SpeciesDiffusion = DiffusionTerms<Formula>;

/// The rate of each species, linearised by the species itself at the present state with factors
/// that vary as if they did not: what stands before lap, lap(lap), …, dxx, dyy, dzz. div(k *
/// grad(e)) is k lap(e); of diffuse the part across axes is added to both sides of the diagonal,
/// whose damping is then no less than the whole. All else (advection, tensors in fluxes, what draws
/// random numbers, other species) is no part of it.
std::vector<SpeciesDiffusion> diffusion_of(const Program& program, std::uint32_t stage);

/// Can the formula's value change while a stage runs?
bool changes_in_time(const Program& program, std::uint32_t stage, const Formula& formula);

}  // namespace cascade
