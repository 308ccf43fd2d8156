// Computes operators as differences between values of neighbouring cells. The value in the cell
// itself is c. The values of its neighbours are N, S, E, W, U and D. The side of a cell is h.
// spec/numerics.md has the same formulas.
#include "lang/lower/lower_pass.h"

#include "core/check.h"

namespace cascade::lowering {

namespace {

class Stencils {
public:
    Stencils(const PassView& pass, KernelAssembly& assembly, const NodeValues& values)
        : pass_(pass),
          graph_(pass.graph),
          axes_(pass.planner.axes()),
          assembly_(assembly),
          builder_(assembly.builder()),
          values_(values),
          grid_(graph_.grid()) {}

    ValueId stencil(const Node& node);

private:
    ValueId over_links(const Node& node);
    ValueId difference(NodeId operand, Difference kind, int first = 0, int second = 0);
    ValueId summed(NodeId operand, Difference kind, int axis) {
        return *values_.weighted(operand, taps_of(kind, axes_, axis));
    }
    ValueId squared_gradient(NodeId operand);
    ValueId advection(const Node& node);
    ValueId upwind(NodeId velocity, NodeId operand, int axis);
    ValueId limited(NodeId operand, int axis);
    ValueId anisotropic(const Node& node);

    FieldSlot slot_of_plane(NodeId id) { return assembly_.field_slot(pass_.plane(id)); }
    ValueId own(NodeId id) const { return values_.number_at(id, {}); }
    ValueId scaled(ValueId value, double factor) const { return values_.scaled(value, factor); }

    const PassView& pass_;
    const PlanGraph& graph_;
    const GridAxes& axes_;
    KernelAssembly& assembly_;
    KernelBuilder& builder_;
    const NodeValues& values_;
    const Grid& grid_;
};

ValueId Stencils::stencil(const Node& node) {
    const NodeId operand = node.reads().back();
    const bool is_theirs = node.calls(Function::theirs), is_beside = node.calls(Function::beside);
    if (graph_.is_uniform(operand)) {
        return is_theirs || is_beside ? own(operand) : builder_.number(0);
    }
    if (is_theirs) return builder_.theirs(slot_of_plane(operand));
    if (graph_.is_linked()) return over_links(node);
    if (const auto applied = difference_of(node.function)) {
        return difference(operand, applied->difference, applied->first, applied->second);
    }
    if (is_beside) {
        const Offset at = Offset::of(node.as<Call>()->detail);
        return *values_.weighted(operand, Taps{{{at, 1}}, 1, 0});
    }
    const int axis = node.as<Call>()->detail;
    switch (node.function) {
        case Function::grad2: return squared_gradient(operand);
        case Function::advect: return advection(node);
        case Function::diffuse: return anisotropic(node);
        case Function::upwind:
            return scaled(upwind(node.operands[0], operand, axis), 1 / grid_.spacing);
        case Function::limited: return limited(operand, axis);
        default: break;
    }
    CHECK(false, "lowering: every operator has its differences");
}

/// Sums over the links of a cell. |∇e|² is computed as (L(e²) − 2 e L(e)) / 2, where L is the
/// Laplacian.
ValueId Stencils::over_links(const Node& node) {
    const NodeId operand = node.reads().back();
    const FieldSlot slot = slot_of_plane(operand);
    if (const Derivative derivative = derivative_of(node.function); derivative.order == 1) {
        constexpr std::array gradients{Op::gradient_x, Op::gradient_y, Op::gradient_z};
        return builder_.over_links(gradients[static_cast<std::size_t>(derivative.first)], slot);
    }
    if (node.function == Function::grad2) {
        return scaled(builder_.over_links(Op::link_squares, slot), 0.5);
    }
    CHECK(node.function == Function::lap, "lowering: other operators are refused on a model");
    if (node.operand_count == 1) return builder_.laplacian(slot);
    if (graph_[node.operands[0]].calls(Function::tensor_weights)) {
        return builder_.link_weighted({slot_of_plane(node.operands[0]), slot});
    }
    return scaled(builder_.link_flow({slot_of_plane(node.operands[0]), slot}), 0.5);
}

/// The difference that a row of lang/program/stencils.cpp describes. 0 if the grid does not have
/// the axis.
ValueId Stencils::difference(NodeId operand, Difference kind, int first, int second) {
    const Taps taps = taps_of(kind, axes_, first, second);
    const double factor = 1 / taps.size(grid_.spacing);
    if (kind == Difference::laplacian && !graph_.has_mask() && pass_.can_read_as_plane(operand)) {
        return scaled(builder_.laplacian(slot_of_plane(operand)), factor);
    }
    const auto sum = values_.weighted(operand, taps, kind == Difference::laplacian);
    return sum ? scaled(*sum, factor) : builder_.number(0);
}

/// The sum of the squares of the central differences, x first.
ValueId Stencils::squared_gradient(NodeId operand) {
    std::optional<ValueId> sum;
    for (const int axis : axes_.present) {
        const ValueId along = difference(operand, Difference::central, axis);
        const ValueId square = builder_.multiply(along, along);
        sum = sum ? builder_.add(*sum, square) : square;
    }
    return sum.value_or(builder_.number(0));
}

/// Σ v · (v > 0 ? c − W : E − c) / h over all axes.
ValueId Stencils::advection(const Node& node) {
    const std::uint32_t velocities = node.operand_count - 1;
    std::optional<ValueId> sum;
    for (const int axis : axes_.present) {
        if (static_cast<std::uint32_t>(axis) >= velocities) continue;
        const ValueId term =
            upwind(node.operands[static_cast<std::size_t>(axis)], node.operands[velocities], axis);
        sum = sum ? builder_.add(*sum, term) : term;
    }
    return scaled(sum.value_or(builder_.number(0)), 1 / grid_.spacing);
}

/// v · (v > 0 ? c − W : E − c).
ValueId Stencils::upwind(NodeId velocity, NodeId operand, int axis) {
    const ValueId v = own(velocity);
    const ValueId backward = summed(operand, Difference::backward, axis);
    const ValueId forward = summed(operand, Difference::forward, axis);
    const ValueId flows_forwards = builder_.apply(Op::less, builder_.number(0), v);
    return builder_.multiply(v, builder_.select(flows_forwards, backward, forward));
}

/// Van Leer's limiter: with a = E − c and b = c − W, the harmonic mean 2ab / (a + b) if both have
/// the same sign, else 0.
ValueId Stencils::limited(NodeId operand, int axis) {
    const ValueId zero = builder_.number(0);
    const ValueId a = summed(operand, Difference::forward, axis);
    const ValueId b = summed(operand, Difference::backward, axis);
    const ValueId is_monotone = builder_.apply(Op::less, zero, builder_.multiply(a, b));
    const ValueId share = builder_.divide(b, builder_.add(a, b));
    const ValueId mean = builder_.multiply(builder_.multiply(builder_.number(2), a), share);
    return builder_.select(is_monotone, mean, zero);
}

/// a11 ∂²c/∂x² + a22 ∂²c/∂y² + 2 a12 ∂²c/∂x∂y, with y pointing down (Witkin & Kass, equation 7).
ValueId Stencils::anisotropic(const Node& node) {
    const Value& tensor = values_.at(node.operands[0], {});
    const NodeId operand = node.operands[1];
    const ValueId along_x =
        builder_.multiply(tensor[0], difference(operand, Difference::second, 0));
    const ValueId along_y =
        builder_.multiply(tensor[2], difference(operand, Difference::second, 1));
    const ValueId across =
        builder_.multiply(tensor[1], difference(operand, Difference::mixed, 0, 1));
    return builder_.add(builder_.add(along_x, along_y), scaled(across, 2));
}

}  // namespace

ValueId lower_stencil(const PassView& pass, KernelAssembly& assembly, const NodeValues& values,
                      NodeId id) {
    return Stencils(pass, assembly, values).stencil(pass.graph[id]);
}

}  // namespace cascade::lowering
