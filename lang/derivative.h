// Derivatives of a system's rates by its species, found by the rules of calculus and simplified.
#pragma once

#include "lang/program.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// ∂(rate of species item `of`) / ∂(value of species item `by` in the same cell), what operators
/// read of neighbours and what is taken over the domain held fixed. Definitions and other rates are
/// put in. Empty where a function without a rule depends on the species.
std::optional<Formula> rate_derivative(const Program& program, std::uint32_t stage,
                                       std::uint32_t of, std::uint32_t by);

/// What bounds the eigenvalues of the Jacobian J of the rates in a state: in each cell the largest
/// over the species of Σ |J_ij|, j being species and cells; the largest of all cells is no smaller
/// than the magnitude of any eigenvalue (S. Gerschgorin, 1931). The derivative of what an operator
/// is applied to is taken at the cell itself.
struct JacobianBound {
    Formula whole;     ///< Reaction and operators.
    Formula reaction;  ///< Without lap of species: what is left when diffusion costs nothing.
    /// Without any operator through which a species reads itself: what is left when waves of each
    /// species are damped at no cost.
    Formula without_own_operators;
};

/// Empty as above, or where the formulas become too large.
std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage);

}  // namespace cascade
