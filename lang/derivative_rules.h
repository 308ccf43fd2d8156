// The rules of calculus, one part of a formula at a time (internal to derivative.cpp).
#pragma once

#include "core/grid.h"
#include "lang/formula_builder.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace cascade {

/// How a part changes with a species.
struct Slope {
    PartId own = 0;  ///< The derivative by the cell's own value.
    /// Σ of the magnitudes of the derivatives through operators and aggregates: by the values of
    /// neighbours, and by the own one where an operator reads it. Never below 0.
    PartId far = 0;
    /// The part of `far` that is not through lap of a species itself: it may make a mode grow.
    PartId wide = 0;
};

/// ∂(part `id`) / ∂(its operand n), the others held fixed, where its function has a rule for it.
std::optional<PartId> partial_derivative(FormulaBuilder& builder, PartId id, std::size_t n);

/// The slope of part `id` by species item `species`, given those of all parts before it. Empty where
/// the part depends on the species and there is no rule for it.
std::optional<Slope> slope_of(FormulaBuilder& builder, PartId id, std::uint32_t species,
                              const std::vector<Slope>& before, const Grid& grid);

}  // namespace cascade
