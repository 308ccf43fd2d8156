// The factors by which operators multiply waves, on the plane, on a surface and on a model, and the
// components of vectors (internal to derivative.cpp).
#pragma once

#include "lang/calculus/algebra.h"
#include "lang/program/models.h"
#include "lang/program/stencils.h"

#include <cstddef>
#include <optional>

namespace cascade {

class OperatorGains {
public:
    /// `model` may be null if only the cell's own value is needed.
    OperatorGains(Algebra& algebra, const Program& program, const ModelFacts* model);

    bool has_axis(std::size_t axis) const;
    bool has_metric() const { return has_metric_; }
    bool is_on_model() const { return links_.has_value(); }

    /// The largest factor of an operator that makes all waves decay; none for other operators.
    std::optional<Term> of_diffusion(const Node& node);
    /// The gain of another operator or an aggregate; none for other functions.
    std::optional<Term> of_other(const Node& node);
    /// Of the derivative along a direction, with faces, and of the central difference.
    Term of_gradient(std::size_t axis);
    Term of_derivative(std::size_t axis);

    /// The components of a vector at the cell itself.
    const SparseVector& components(NodeId vector) { return vectors_.components(vector); }
    /// The central difference of a number along an axis; 0 along one that the grid does not have.
    Term derivative(NodeId of, std::size_t axis);

private:
    Term metric(MetricPlane plane);
    double largest(Difference difference) const;

    Algebra& algebra_;
    const Grid& grid_;
    bool has_metric_;
    StencilKind stencil_;
    std::optional<double> links_;  ///< The largest sum of weights of a cell's links, on a model.
    Term zero_;
    FieldVectors vectors_;
};

}  // namespace cascade
