// Derivatives of a system's rates by its species, found by the rules of calculus and simplified.
#pragma once

#include "lang/program/models.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// ∂(rate of species item `of`) / ∂(value of species item `by` in the same cell), what operators
/// read of neighbours and what is taken over the domain held fixed. Definitions and other rates are
/// put in. Empty where a function without a rule depends on the species.
std::optional<Formula> rate_derivative(const Program& program, std::uint32_t stage,
                                       std::uint32_t of, std::uint32_t by);

/// Bounds of the Jacobian J of the rates in a state, each one number: the largest of all cells (an
/// aggregate over the domain). Coefficients of operators are taken at the cell itself; see
/// slopes.h.
struct JacobianBound {
    /// Of the magnitude of the eigenvalues: the largest Σ |J_ij| of a row i, j being species and
    /// cells (S. Gerschgorin, 1931). It bounds the step of an explicit method, or its stages.
    Formula whole;
    /// Of what stages do not tame: the reaction, waves, and the growth that operators cause, as
    /// -lap(c) does in lap(c^3 - c - lap(c)). It bounds the step of a stabilised method.
    Formula reaction;
    /// Does a rate jump where a species passes a threshold? The reaction is faster there than it
    /// says.
    bool jumps = false;
};

/// Empty as above, or where the formulas become too large. `model` is what is known of the model
/// that is the domain; null on grids.
std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage,
                                            const ModelFacts* model = nullptr);

}  // namespace cascade
