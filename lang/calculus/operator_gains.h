// Gains, which are the factors by which operators on planes, surfaces and models multiply waves.
// Also the components of vectors. Internal to derivative.cpp.
#pragma once

#include "lang/calculus/algebra.h"
#include "lang/program/models.h"
#include "lang/program/stencils.h"

#include <cstddef>
#include <optional>

namespace cascade {

class OperatorGains {
public:
    /// `model` may be null if only derivatives with respect to the cell's own value are needed.
    OperatorGains(Algebra& algebra, const Program& program, const ModelFacts* model);

    bool has_axis(std::size_t axis) const;
    bool has_metric() const { return has_metric_; }
    bool is_on_model() const { return links_.has_value(); }

    /// The largest factor by which an operator of diffusion, which damps all waves, multiplies a
    /// wave; nullopt for operators that are not diffusion.
    std::optional<Term> of_diffusion(const Node& node);
    /// The largest factor by which an aggregate or an operator that is not diffusion multiplies a
    /// wave; nullopt for other functions.
    std::optional<Term> of_other(const Node& node);
    /// The gain of the derivative along an axis. of_gradient() is the gain of the difference
    /// between adjacent cells, from which fluxes through faces are computed. of_derivative() is the
    /// gain of the central difference.
    Term of_gradient(std::size_t axis);
    Term of_derivative(std::size_t axis);

    /// The components of a vector in the cell itself.
    const SparseVector& components(NodeId vector) { return vectors_.components(vector); }
    /// The central difference of a number along an axis; 0 if the grid does not have this axis.
    Term derivative(NodeId of, std::size_t axis);

private:
    Term metric(MetricPlane plane);
    double largest(Difference difference) const;

    Algebra& algebra_;
    const Grid& grid_;
    bool has_metric_;
    StencilKind stencil_;
    /// On a model, the largest sum of the weights of one cell's links.
    std::optional<double> links_;
    Term zero_;
    FieldVectors vectors_;
};

}  // namespace cascade
