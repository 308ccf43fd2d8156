// The change of the domain's lengths while a stage runs.
#pragma once

#include "lang/program/formula.h"

#include <array>

namespace cascade {

/// The growth of the domain in a stage (spec/domain.md, Growth). The number of cells stays the
/// same, so cells become longer. let_lengths_grow() writes the growth into the stage's equations.
struct Growth {
    /// For each axis, the length of the domain divided by its length on the grid (cells · spacing):
    /// a formula of numbers and `t`, 1 if the length does not change. On a surface or model the
    /// first two are equal, and are the longest side divided by the longest side of the domain.
    std::array<Formula, 3> scale;
    /// The rate at which growth dilutes amounts, d/dt ln(content of the domain), as a formula of
    /// numbers and `t`.
    Formula dilution;
    /// Whether lengths along all axes with more than one cell grow by the same scale.
    bool is_uniform = true;
    /// The system of the stage as it is in the script, in which lengths do not grow.
    SystemId written;
    Span span;  ///< Where the script sets the lengths.
};

}  // namespace cascade
