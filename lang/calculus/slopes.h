// How parts of a formula change with a species, through the cell's own value and through operators
// (internal to derivative.cpp).
//
// For operators, coefficients count as if they were the same all around the cell ("frozen"); an
// operator then multiplies each wave by a factor. Operators of diffusion make no wave grow and damp
// the shortest one most: the factor is −gain · x, with x from 0 (long waves) to 1. Several of them
// in each other give a polynomial of x, whose coefficients are kept, so that decay and possible
// growth stay separate.
#pragma once

#include "lang/calculus/operator_gains.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The change of a number, or of one component of a vector at the faces.
struct Slope {
    Term own;  ///< The derivative by the cell's own value, without operators.
    /// Σ of the magnitudes of the derivatives through operators and aggregates, over all cells: no
    /// wave is multiplied by more. Never below 0.
    Term far;
    /// The part that is diffusion: diffusion[k] is the coefficient of (−x)^(k+1). For a vector's
    /// component, [k] is the factor of the gradient of what would be (−x)^k, so that its divergence
    /// has the same coefficients.
    std::vector<Term> diffusion;
    /// The magnitude of the rest: waves that travel, mixed derivatives, aggregates.
    Term other;
    /// Does it jump where the species passes a threshold? The derivatives do not show this.
    bool jumps = false;
};
/// For a number the first one; for a vector one for each axis.
using Slopes = std::array<Slope, 3>;

class SlopeRules {
public:
    /// `model` may be null if only the cell's own value is needed.
    SlopeRules(Algebra& algebra, const Program& program, const ModelFacts* model);

    /// The slopes of part `id` by `species`, given those of all earlier parts. Empty
    /// if the part depends on the species and has no rule.
    std::optional<Slopes> slopes_of(NodeId id, ItemId species,
                                    const IdVector<NodeId, Slopes>& before);

private:
    Term term(NodeId id) const { return {&algebra_, id}; }
    Slope zero() const { return {zero_, zero_, {}, zero_, false}; }
    bool is_zero(const Slope& slope) const;
    Term all_of(const Slope& slope) { return abs(slope.own) + slope.far; }
    void add(Slope& sum, const Slope& slope);
    Slope scaled(const Slope& slope, Term factor);
    Slope through_diffusion(const Slope& slope, Term gain);
    Slope through_other(const Slope& slope, Term gain);
    Slope as_other(const Slope& slope, Term factor);

    std::optional<Slope> of_number(const Node& node, const IdVector<NodeId, Slopes>& before);
    std::optional<Slope> by_partials(const Node& node, const IdVector<NodeId, Slopes>& before);
    Slope of_squared_gradient(const Node& node, const Slope& inner);
    Slope of_advection(const Node& node, const IdVector<NodeId, Slopes>& before);
    Slope of_divergence(const Slopes& flux);
    std::optional<Slopes> of_vector(const Node& node, const IdVector<NodeId, Slopes>& before);
    struct OfVectors;
    template <typename Make>
    Slopes along_axes(const Make& make);
    Slopes times_model_tensor(const Node& tensor, const Slopes& flux);
    Slopes times_tensor(NodeId tensor, const Slopes& flux);

    Algebra& algebra_;
    OperatorGains gains_;
    Term zero_;
};

}  // namespace cascade
