// Writes the growth of a domain into equations: derivatives are divided by the scales of lengths,
// lengths of the domain are multiplied by the scales, and species are diluted.
#pragma once

#include "lang/program/program.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// Changes every stage whose domain grows into the same stage on a grid that does not grow. With
/// the scales s of lengths along the axes:
/// - ∂/∂x becomes 1/s ∂/∂x, and a Laplacian becomes the sum of second derivatives divided by s²;
/// - lengths and contents of the domain, which the checker marks by `(grown)`, are multiplied by s;
/// - slopes at sides are multiplied by s, and fluxes are divided by s;
/// - dilution · species is subtracted from the rate of each species that is not in
///   Stage::undiluted.
///
/// Starting values are computed with the lengths at t = 0. The stage gets its own copy of its
/// system, and Growth::written is set to the original system. A rate that other formulas read
/// becomes a definition without the dilution.
void let_lengths_grow(Program& program);

/// Rewrites a formula of a stage, such as a picture's formula, for lengths that grow. The
/// definitions that the formula reads must be definitions of Growth::written.
Formula with_growth(const Program& program, std::uint32_t stage, const Formula& formula);

/// A length of the domain that may grow.
struct GrowingSide {
    std::size_t axis;       ///< The scale of this axis multiplies it.
    std::string_view name;  ///< Such as "the length along x".
    double start = 0;       ///< The length without growth. 0 on a model without an extent.
};

/// The lengths along all axes with more than one cell. A surface or model has only one, which is
/// the longest side of its box.
std::vector<GrowingSide> growing_sides(const DomainSettings& domain);

/// The duration of a stage if nothing ends it sooner. Empty if it is not known before the run.
std::optional<double> known_duration(const Program& program, std::uint32_t stage);

/// The scales of lengths along the axes at the time t of a stage. A scale is 1 if lengths along the
/// axis do not change.
std::array<double, 3> scales_at(const Stage& stage, double t);

}  // namespace cascade
