// Stages whose lengths are scaled, so that their pattern has a wanted size.
#pragma once

#include "lang/program/program.h"

#include <cstdint>

namespace cascade {

/// The program with all lengths in the equations of a stage multiplied by `factor`: its pattern is
/// larger by this factor and grows in the same time. A derivative of order n in rates and
/// definitions is multiplied by factorⁿ, so that this is exact for any operator, and so are
/// integrals over a model, white noise, and slopes and fluxes that the system or the stage gives
/// its sides. Starting values, places, the sides of the domain and pictures stay in lengths of the
/// domain. Ids of items and definitions stay; the stage gets a system of its own.
Program with_lengths(const Program& program, std::uint32_t stage, double factor);

/// The number of axes along which the cells of the domain have neighbours.
int axes_of(const DomainSettings& domain);

}  // namespace cascade
