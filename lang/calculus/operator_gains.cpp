// Finds gains by Gershgorin's circles and by the symbols of differences.
#include "lang/calculus/operator_gains.h"

#include <algorithm>
#include <cmath>

namespace cascade {

OperatorGains::OperatorGains(Algebra& algebra, const Program& program, const ModelFacts* model)
    : algebra_(algebra),
      grid_(model ? model->grid : program.domain.grid),
      has_metric_(program.domain.surface && program.domain.surface->has_metric),
      stencil_(program.domain.stencil),
      links_(model ? std::optional(model->largest_weight) : std::nullopt),
      zero_{&algebra, algebra.number(0)},
      vectors_(algebra, {{has_axis(0), has_axis(1), has_axis(2)},
                         has_metric_,
                         program.domain.model.has_value()}) {}

bool OperatorGains::has_axis(std::size_t axis) const {
    if (links_) return true;  // Gradients on a model have three components.
    const Stencil stencil = grid_.stencil();
    return axis == 0 ? stencil.x : axis == 1 ? stencil.y : stencil.z;
}

Term OperatorGains::metric(MetricPlane plane) { return {&algebra_, algebra_.leaf(plane)}; }

/// The gain is 2 / h, because a difference across a face adds the magnitudes in both cells. On a
/// surface the gain is multiplied by entries of Ṽ⁻¹. The second direction has two entries, because
/// it has parts along columns and along rows.
Term OperatorGains::of_gradient(std::size_t axis) {
    // On a model, a gradient and a divergence together make a Laplacian, which has parts along
    // three axes.
    if (links_) return zero_.number(std::sqrt(2 * *links_ / 3));
    const Term plane = zero_.number(2 / grid_.spacing);
    if (!has_metric_) return plane;
    const auto size = [&](MetricPlane entry) { return abs(metric(entry)); };
    if (axis == 0) return plane * size(MetricPlane::inverse_11);
    return plane * (size(MetricPlane::inverse_12) + size(MetricPlane::inverse_22));
}

double OperatorGains::largest(Difference difference) const {
    const int axes = std::max(grid_.stencil().axes(), 1);
    return stencil_row(stencil_, difference).largest[static_cast<std::size_t>(axes - 1)];
}

Term OperatorGains::of_derivative(std::size_t axis) {
    return zero_.number(largest(Difference::central) / 2) * of_gradient(axis);
}

/// For lap, each neighbour counts 1, and the cell itself counts as many as all its neighbours. For
/// a tensor, the gain follows from the tensor's trace (SlopeRules::times_tensor).
std::optional<Term> OperatorGains::of_diffusion(const Node& node) {
    const double along_axis = 4 / (grid_.spacing * grid_.spacing);
    const auto applied = difference_of(node.function);
    if (applied && applied->difference == Difference::laplacian) {
        // By Gershgorin's theorem, the cell counts as much as all its neighbours together.
        if (links_) return zero_.number(2 * *links_);
        if (has_metric_) {
            const Term trace = metric(MetricPlane::flow_11) + metric(MetricPlane::flow_22);
            return zero_.number(4) * (trace / metric(MetricPlane::area));
        }
    }
    const bool decays = applied && (applied->difference == Difference::laplacian ||
                                    applied->difference == Difference::second);
    if (decays) return zero_.number(along_axis * (largest(applied->difference) / 4));
    if (node.function != Function::diffuse) return std::nullopt;
    const Term a1{&algebra_, node.operands[1]}, a2{&algebra_, node.operands[2]};
    if (!has_metric_) {
        return zero_.number(along_axis) * (a1 * a1 + a2 * a2);
    }
    // The trace of Ṽ⁻¹ A Ṽ⁻ᵀ.
    const auto [a11, a12, a22] = tensor_entries(algebra_, a1, a2, node.operands[3]);
    const Term p = metric(MetricPlane::inverse_11), q = metric(MetricPlane::inverse_12);
    const Term r = metric(MetricPlane::inverse_22);
    const Term in_columns = p * p * a11 + (zero_.number(2) * (p * q) * a12 + q * q * a22);
    return zero_.number(4) * (in_columns + r * r * a22);
}

std::optional<Term> OperatorGains::of_other(const Node& node) {
    const double h = grid_.spacing;
    if (const auto applied = difference_of(node.function)) {
        if (applied->difference == Difference::central) {
            return of_derivative(static_cast<std::size_t>(applied->first));
        }
        if (applied->difference != Difference::mixed) return std::nullopt;
        const double along = largest(Difference::central);
        return zero_.number(along * along / (h * h));
    }
    if (node.calls(Function::shifted)) return zero_.number(1);
    if (!info(node.function).is_aggregate) return std::nullopt;
    const bool adds = reduction_of(node.function) == ReductionKind::sum;
    return zero_.number(adds ? static_cast<double>(grid_.cell_count()) : 1);
}

Term OperatorGains::derivative(NodeId of, std::size_t axis) {
    if (algebra_.is_number(of) || !has_axis(axis)) return zero_;
    return Term::call(first_derivatives[axis], Term{&algebra_, of});
}

}  // namespace cascade
