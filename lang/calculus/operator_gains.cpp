// Gains by Gershgorin's circles and by the symbols of differences.
#include "lang/calculus/operator_gains.h"

#include "core/check.h"

#include <cmath>

namespace cascade {

OperatorGains::OperatorGains(Algebra& algebra, const Program& program, const ModelFacts* model)
    : algebra_(algebra),
      grid_(model ? model->grid : program.domain.grid),
      has_metric_(program.domain.surface && program.domain.surface->has_metric),
      stencil_(program.domain.stencil),
      links_(model ? std::optional(model->largest_weight) : std::nullopt),
      zero_(algebra.number(0)),
      vectors_(algebra, {{has_axis(0), has_axis(1), has_axis(2)},
                         has_metric_,
                         program.domain.model.has_value()}) {}

bool OperatorGains::has_axis(std::size_t axis) const {
    if (links_) return true;  // Gradients on a model have three components.
    const Stencil stencil = grid_.stencil();
    return axis == 0 ? stencil.x : axis == 1 ? stencil.y : stencil.z;
}

NodeId OperatorGains::metric(MetricPlane plane) { return algebra_.leaf(plane); }

/// 2 / h: a difference across a face counts both cells. On a surface it is multiplied by entries of
/// Ṽ⁻¹; the second direction has parts along columns and along rows.
NodeId OperatorGains::of_gradient(std::size_t axis) {
    // A gradient and a divergence make a Laplacian, which has parts along three axes.
    if (links_) return algebra_.number(std::sqrt(2 * *links_ / 3));
    const NodeId plane = algebra_.number(2 / grid_.spacing);
    if (!has_metric_) return plane;
    const auto size = [&](MetricPlane entry) { return algebra_.magnitude(metric(entry)); };
    if (axis == 0) return algebra_.product(plane, size(MetricPlane::inverse_11));
    return algebra_.product(plane, algebra_.sum(size(MetricPlane::inverse_12),
                                                size(MetricPlane::inverse_22)));
}

/// By the symbols, with X = 4 sin²(θ/2) along each axis: the sum of X is at most 4 n, that of X +
/// X²/12 at most 16/3 n, and the sum of X minus that of XY/6 over pairs of axes at most 16/3, where
/// two are 4.
double OperatorGains::of_stencil(int axes) const {
    switch (stencil_) {
        case StencilKind::cross: break;
        case StencilKind::isotropic: return axes == 1 ? 1 : 4.0 / 3;
        case StencilKind::fourth: return 4.0 / 3 * axes;
    }
    return axes;
}

/// sin θ is at most 1, and sin θ (1 + 2/3 sin²(θ/2)) at most 1.3723.
NodeId OperatorGains::of_derivative(std::size_t axis) {
    const double factor = stencil_ == StencilKind::fourth ? 11.0 / 8 : 1;
    return algebra_.product(algebra_.number(factor / 2), of_gradient(axis));
}

/// For lap, each neighbour counts 1 and the cell as much as all of them; for a tensor, its trace
/// counts (see SlopeRules::times_tensor).
std::optional<NodeId> OperatorGains::of_diffusion(const Node& node) {
    const double along_axis = 4 / (grid_.spacing * grid_.spacing);
    switch (node.function) {
        case Function::lap: {
            // Gershgorin: the cell counts as much as its neighbours together.
            if (links_) return algebra_.number(2 * *links_);
            if (!has_metric_)
                return algebra_.number(along_axis * of_stencil(grid_.stencil().axes()));
            const NodeId trace =
                algebra_.sum(metric(MetricPlane::flow_11), metric(MetricPlane::flow_22));
            return algebra_.product(algebra_.number(4),
                                    algebra_.quotient(trace, metric(MetricPlane::area)));
        }
        case Function::diffuse: break;
        default: {
            const Derivative derivative = derivative_of(node.function);
            const bool decays = derivative.order == 2 && !derivative.is_mixed();
            if (!decays) return std::nullopt;
            return algebra_.number(along_axis * (stencil_ == StencilKind::fourth ? 4.0 / 3 : 1));
        }
    }
    const NodeId a1 = node.operands[1], a2 = node.operands[2];
    if (!has_metric_) {
        return algebra_.product(algebra_.number(along_axis),
                                algebra_.sum(algebra_.product(a1, a1), algebra_.product(a2, a2)));
    }
    // The trace of Ṽ⁻¹ A Ṽ⁻ᵀ.
    const auto [a11, a12, a22] = tensor_entries(algebra_, a1, a2, node.operands[3]);
    const NodeId p = metric(MetricPlane::inverse_11), q = metric(MetricPlane::inverse_12);
    const NodeId r = metric(MetricPlane::inverse_22);
    const NodeId in_columns = algebra_.sum(
        algebra_.product(algebra_.product(p, p), a11),
        algebra_.sum(algebra_.product(algebra_.product(algebra_.number(2), algebra_.product(p, q)),
                                      a12),
                     algebra_.product(algebra_.product(q, q), a22)));
    return algebra_.product(algebra_.number(4),
                            algebra_.sum(in_columns,
                                         algebra_.product(algebra_.product(r, r), a22)));
}

std::optional<NodeId> OperatorGains::of_other(const Node& node) {
    const double h = grid_.spacing;
    const Derivative derivative = derivative_of(node.function);
    if (derivative.order == 1) {
        return of_derivative(static_cast<std::size_t>(derivative.first));
    }
    if (derivative.is_mixed()) {
        const double factor = stencil_ == StencilKind::fourth ? 11.0 / 8 : 1;
        return algebra_.number(factor * factor / (h * h));
    }
    if (!info(node.function).is_aggregate) return std::nullopt;
    const bool adds = node.function == Function::domain_sum;
    return algebra_.number(adds ? static_cast<double>(grid_.cell_count()) : 1);
}

NodeId OperatorGains::derivative(NodeId of, std::size_t axis) {
    if (algebra_.is_number(of) || !has_axis(axis)) return zero_;
    return algebra_.call(first_derivatives[axis], {of});
}

}  // namespace cascade
