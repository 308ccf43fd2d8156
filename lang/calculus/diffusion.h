// The part of each rate that is diffusion of its own species, which semi-implicit solvers take
// implicitly.
#pragma once

#include "ir/diffusion.h"
#include "lang/program/program.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// A formula for each factor of a species' diffusion; no nodes if it is 0. Its largest value over
/// the cells is used.
using SpeciesDiffusion = DiffusionTerms<Formula>;

/// The diffusion of each species: its rate is linearised by the species itself at the present
/// state, as if factors were the same in all cells, and the factors of lap, lap(lap), …, dxx, dyy,
/// dzz are collected. div(k * grad(e)) counts as k lap(e). The part of diffuse across the axes has
/// a factor of its own where its coefficients are the same in all cells and x and y are periodic;
/// elsewhere it is added to both diagonal entries, so that they damp at least as much as the whole.
/// A derivative by the own value that is the same in all cells is decay, if there is any diffusion.
/// Everything else (advection, tensors in fluxes, random numbers, other species) is left out.
IdVector<SpeciesId, SpeciesDiffusion> diffusion_of(const Program& program, std::uint32_t stage);

/// Can the formula's value change while a stage runs?
bool changes_in_time(const Program& program, std::uint32_t stage, const Formula& formula);

}  // namespace cascade
