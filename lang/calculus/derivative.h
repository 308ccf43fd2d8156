// Derivatives of a system's rates with respect to its species, by the rules of calculus and
// simplified.
#pragma once

#include "lang/calculus/algebra.h"
#include "lang/program/models.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// The derivatives of all rates by the values of all species in the same cell. Values that
/// operators read at neighbours, and aggregates, are held constant.
struct LocalJacobian {
    /// Definitions and other rates are expanded. Nodes that were written were written in the
    /// formulas of the rates, numbered as Flattening::add_rates() does.
    Algebra algebra;
    /// rows[of][by] is the derivative of the rate of one species by the value of another.
    IdVector<SpeciesId, IdVector<SpeciesId, NodeId>> rows;
};
/// Empty if a function without a rule depends on a species, or if the formulas become too large.
std::optional<LocalJacobian> local_jacobian(const Program& program, std::uint32_t stage);

/// Bounds of the Jacobian J of the rates in a state. Each is one number, the largest over all cells
/// (an aggregate over the domain). Coefficients of operators are taken at the cell itself; see
/// slopes.h.
struct JacobianBound {
    /// Of the magnitude of the eigenvalues: the largest Σ |J_ij| of a row i, where i and j are
    /// pairs of a species and a cell (S. Gerschgorin, 1931). It limits the step, or the number of
    /// stages, of an explicit method.
    Formula whole;
    /// Of the part that stages do not stabilise: the reaction, waves, and the growth that operators
    /// cause, as -lap(c) does in lap(c^3 - c - lap(c)). It limits the step of a stabilised method.
    Formula reaction;
    /// Of the part that a method does not stabilise that takes the reaction of each cell
    /// implicitly: what operators and aggregates read in other cells. It limits the step of such a
    /// method.
    Formula spread;
    /// The fastest growth of a species by itself in its cell, 0 if none grows. The equations of
    /// such a method are singular at steps that are too long for it.
    Formula growth;
    /// Does a rate jump where a species passes a threshold? The reaction is then faster there than
    /// the bound.
    bool jumps = false;
};

/// Empty as above, or if the formulas become too large. `model` has facts about the model that is
/// the domain; null on grids.
std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage,
                                            const ModelFacts* model = nullptr);

}  // namespace cascade
