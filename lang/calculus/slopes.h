// How much the subexpressions of a formula change if a species changes, either in the cell itself
// or in cells that operators read (internal to derivative.cpp).
//
// Coefficients of operators count as if they were the same in all cells around the cell. With such
// coefficients, an operator multiplies each wave by a factor. For operators of diffusion the factor
// is −gain · x, with x from 0 (long waves) to 1 (the shortest wave), so no wave grows. Nested
// operators of diffusion give a polynomial of x. The coefficients of the polynomial are stored one
// by one, so that decay and possible growth remain separate.
#pragma once

#include "lang/calculus/operator_gains.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The derivative, with respect to a species, of a number or of one component of a vector at faces.
struct Slope {
    Term own;  ///< The derivative with respect to the cell's own value, without operators.
    /// The sum of the magnitudes of the derivatives with respect to the values of all cells that
    /// operators and aggregates read. No wave is multiplied by a factor larger than this sum. Never
    /// below 0.
    Term far;
    /// The part that is diffusion. For a number, diffusion[k] is the coefficient of (−x)^(k+1). For
    /// a component of a vector, diffusion[k] is the factor of the gradient of the term (−x)^k, so
    /// that the divergence of the vector has the same coefficients.
    std::vector<Term> diffusion;
    /// The magnitude of all other parts: travelling waves, mixed derivatives, aggregates.
    Term other;
    /// Whether the value jumps where the species passes a threshold. The derivatives above do not
    /// include the jump.
    bool jumps = false;
};
/// The slopes of a number or a vector. A number uses only the first element. A vector uses one
/// element for each axis.
using Slopes = std::array<Slope, 3>;

class SlopeRules {
public:
    /// `model` may be null if only derivatives with respect to the cell's own value are needed.
    SlopeRules(Algebra& algebra, const Program& program, const ModelFacts* model);

    /// The slopes of node `id` with respect to `species`, given the slopes of all earlier nodes.
    /// nullopt if the node depends on the species and there is no rule for this node.
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
