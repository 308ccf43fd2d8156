// Derivatives of a system's rates with respect to its species. The rules of calculus give these
// derivatives, which are then simplified.
#pragma once

#include "lang/calculus/algebra.h"
#include "lang/program/models.h"

#include <cstdint>
#include <optional>

namespace cascade {

/// The derivatives of all rates with respect to the values of all species in the same cell.
/// Aggregates, and values that operators read at neighbours, are held constant.
struct LocalJacobian {
    /// Contains the rates, in which definitions and other rates are replaced by their formulas. For
    /// each node, `written` says from which formula, and from which position in it, the node comes.
    /// Formulas are numbered as by Flattening::add_rates().
    Algebra algebra;
    /// rows[of][by] is the derivative of the rate of species `of` with respect to the value of
    /// species `by`.
    IdVector<SpeciesId, IdVector<SpeciesId, NodeId>> rows;
};
/// The Jacobian of a stage. nullopt if there is no rule for a function that depends on a species,
/// or if the formulas become too large.
std::optional<LocalJacobian> local_jacobian(const Program& program, std::uint32_t stage);

/// Bounds of the Jacobian J of the rates, evaluated at a state. Each bound is a formula with a
/// single value, which is the maximum over all cells. slopes.h explains what operators contribute.
struct JacobianBound {
    /// A bound of the eigenvalues' magnitude: the largest sum Σ_j |J_ij| in any row i, where each
    /// index stands for one species in one cell (S. Gerschgorin, 1931). This bound limits the step
    /// of an explicit method, or determines how many stages the method has.
    Formula whole;
    /// A bound for the part of J that additional stages do not stabilise. This part consists of the
    /// reaction, waves, and growth that operators cause, such as the growth by -lap(c) in lap(c^3 -
    /// c - lap(c)). The bound limits the step of a stabilised method.
    Formula reaction;
    /// A bound for the part of J that reads other cells, through operators and aggregates. The
    /// bound limits the step of a method that treats the reaction in each cell implicitly.
    Formula spread;
    /// The largest rate at which a species grows by itself in its cell; 0 if no species grows. A
    /// method that treats the reaction in each cell implicitly must not take steps as long as 1 /
    /// growth, because its equations are then singular.
    Formula growth;
    /// Whether a rate jumps where a species passes a threshold. At the jump the reaction is faster
    /// than these bounds.
    bool jumps = false;
};

/// The bounds for a stage. nullopt if there is no rule for a function that depends on a species, or
/// if the formulas become too large. `model` describes the model on which the stage runs, and is
/// null on grids.
std::optional<JacobianBound> jacobian_bound(const Program& program, std::uint32_t stage,
                                            const ModelFacts* model = nullptr);

}  // namespace cascade
