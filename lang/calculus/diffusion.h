// Finds the part of each rate that is diffusion of the rate's own species. Semi-implicit solvers
// treat this part implicitly.
#pragma once

#include "core/side.h"
#include "ir/diffusion.h"
#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// For each factor of a species' diffusion, a formula. A factor of 0 is a formula without nodes.
/// Solvers use the largest value of each formula over all cells.
using SpeciesDiffusion = DiffusionTerms<Formula>;

/// The diffusion of each species. The rate is linearised at the present state with respect to its
/// own species. Coefficients count as if they were the same in all cells. Then the factors of lap,
/// lap(lap), …, dxx, dyy, dzz are collected.
/// - div(k * grad(e)) counts as k lap(e).
/// - Mixed derivatives in diffuse(…) get a factor of their own if x and y are periodic and the
///   coefficients are the same in all cells. Otherwise they are added to the two unmixed
///   derivatives, which then damp at least as much as the whole operator.
/// - A derivative with respect to the species' own value that is the same in all cells counts as
///   decay, if there is any diffusion.
/// - Everything else (advection, tensors in fluxes, random numbers, other species) is left out.
///
/// If `face` is given, positions in factors outside of operators are positions at the faces of this
/// side, and not at the centres of the cells beside the side. A factor inside div(k * grad(e)) is
/// read at the centres, because div mirrors it at the side.
IdVector<SpeciesId, SpeciesDiffusion> diffusion_of(const Program& program, std::uint32_t stage,
                                                   std::optional<Side> face = {});

/// Whether the formula's value can change while the stage runs.
bool changes_in_time(const Program& program, std::uint32_t stage, const Formula& formula);

}  // namespace cascade
