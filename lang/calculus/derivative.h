// Derivatives of a system's rates with respect to its species, found by the rules of calculus and
// simplified.
#pragma once

#include "lang/calculus/algebra.h"
#include "lang/program/models.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// The derivatives of all rates with respect to the values of all species in the same cell.
/// Aggregates, and values that operators read at neighbours, are held constant.
struct LocalJacobian {
    /// Contains the rates, with definitions and other rates expanded. For each node, `written`
    /// gives the formula and the position in it from which the node comes. Formulas are numbered as
    /// by Flattening::add_rates().
    Algebra algebra;
    /// rows[of][by] is the derivative of the rate of species `of` with respect to species `by`.
    IdVector<SpeciesId, IdVector<SpeciesId, NodeId>> rows;
};
/// The Jacobian of a stage. Empty if there is no rule for a function that depends on a species, or
/// if the formulas become too large.
std::optional<LocalJacobian> local_jacobian(const Program& program, std::uint32_t stage);

/// Bounds of the Jacobian J of the rates, evaluated at a state. Each bound is a formula with a
/// single value: an aggregate, the maximum over all cells. slopes.h explains what operators
/// contribute.
struct JacobianBound {
    /// A bound of the eigenvalues' magnitude: the largest sum Σ_j |J_ij| in any row i, where each
    /// index stands for one species in one cell (S. Gerschgorin, 1931). It limits the step of an
    /// explicit method, or sets its number of stages.
    Formula whole;
    /// A bound for the part of J that additional stages do not stabilise: the reaction, waves, and
    /// growth caused by operators, such as the growth by -lap(c) in lap(c^3 - c - lap(c)). It
    /// limits the step of a stabilised method.
    Formula reaction;
    /// A bound for the part of J that reads other cells, by operators and aggregates. It limits the
    /// step of a method that takes the reaction in each cell implicitly.
    Formula spread;
    /// The fastest growth of a species by itself in its cell; 0 if no species grows. A method that
    /// takes the reaction in each cell implicitly must not take steps as long as 1 / growth,
    /// because its equations are then singular.
    Formula growth;
    /// Whether a rate jumps where a species passes a threshold. At the jump the reaction is faster
    /// than these bounds.
    bool jumps = false;
};

/// The bounds for a stage. Empty if there is no rule for a function that depends on a species, or
/// if the formulas become too large. `model` describes the model on which the stage runs. Null on
/// grids.
std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage,
                                            const ModelFacts* model = nullptr);

}  // namespace cascade
