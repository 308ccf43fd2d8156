// Scales the lengths in a stage, so that the stage's pattern gets a given size.
#pragma once

#include "lang/program/program.h"

#include <cstdint>

namespace cascade {

/// A copy of the program in which all lengths in the equations of a stage are multiplied by
/// `factor`. The pattern becomes larger by this factor and grows in the same time. A derivative of
/// order n in rates and definitions is multiplied by factorⁿ, which is exact for any operator.
/// Integrals over a model, white noise, and those slopes and fluxes at sides that the system or the
/// stage sets are scaled, too. Starting values, positions, sides of the domain and pictures keep
/// the original lengths. Ids of items and definitions do not change. The stage gets its own copy of
/// its system.
Program with_lengths(const Program& program, std::uint32_t stage, double factor);

/// The number of axes along which the cells of the domain have neighbours.
int axes_of(const DomainSettings& domain);

}  // namespace cascade
