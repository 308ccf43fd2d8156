// Operators as differences between values of neighbouring cells. c is the cell itself; N, S, E, W,
// U and D are its neighbours; h is the side of a cell. Spec/numerics.md has the same formulas.
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
    ValueId laplacian(NodeId operand);
    ValueId isotropic(NodeId operand);
    ValueId sum_of_neighbours(NodeId operand);
    ValueId difference(NodeId operand, int axis);
    ValueId second_difference(NodeId operand, int axis);
    ValueId cross_difference(NodeId operand, int first, int second);
    ValueId squared_gradient(NodeId operand);
    ValueId advection(const Node& node);
    ValueId upwind(const Node& node);
    ValueId limited(const Node& node);
    ValueId anisotropic(const Node& node);

    FieldSlot slot_of_plane(NodeId id) { return assembly_.field_slot(pass_.plane(id)); }
    ValueId own(NodeId id) const { return values_.number_at(id, {}); }
    ValueId beside(NodeId id, Offset offset) const { return values_.beside(id, offset); }
    ValueId scaled(ValueId value, double factor) const { return values_.scaled(value, factor); }

    const PassView& pass_;
    const PlanGraph& graph_;
    const Axes& axes_;
    KernelAssembly& assembly_;
    KernelBuilder& builder_;
    const NodeValues& values_;
    const Grid& grid_;
};

ValueId Stencils::stencil(const Node& node) {
    const NodeId operand = node.reads().back();
    const bool is_theirs = node.calls(Function::theirs);
    if (graph_.is_uniform(operand)) return is_theirs ? own(operand) : builder_.number(0);
    if (is_theirs) return builder_.theirs(slot_of_plane(operand));
    if (graph_.is_linked()) return over_links(node);
    const auto [order, first, second] = derivative_of(node.function);
    if (order == 1) return difference(operand, first);
    if (order == 2 && first == second) return second_difference(operand, first);
    if (order == 2) return cross_difference(operand, first, second);
    switch (node.function) {
        case Function::lap: return laplacian(operand);
        case Function::isotropic: return isotropic(operand);
        case Function::grad2: return squared_gradient(operand);
        case Function::advect: return advection(node);
        case Function::diffuse: return anisotropic(node);
        case Function::upwind: return upwind(node);
        case Function::limited: return limited(node);
        default: break;
    }
    CHECK(false, "lowering: every operator has its differences");
}

/// Sums over the links of a cell. |∇e|² is half of the Laplacian of e² minus e times that of e.
ValueId Stencils::over_links(const Node& node) {
    const NodeId operand = node.reads().back();
    const FieldSlot slot = slot_of_plane(operand);
    if (const Derivative derivative = derivative_of(node.function); derivative.order == 1) {
        constexpr std::array gradients{Op::gradient_x, Op::gradient_y, Op::gradient_z};
        return builder_.over_links(gradients[static_cast<std::size_t>(derivative.first)], slot);
    }
    switch (node.function) {
        case Function::lap:
            if (node.operand_count == 1) return builder_.laplacian(slot);
            return scaled(builder_.link_flow({slot_of_plane(node.operands[0]), slot}), 0.5);
        case Function::grad2: return scaled(builder_.over_links(Op::link_squares, slot), 0.5);
        default: break;
    }
    CHECK(false, "lowering: operators without a meaning on a model are refused");
}

/// ((((N + S) + E) + W) + U) + D.
ValueId Stencils::sum_of_neighbours(NodeId operand) {
    std::optional<ValueId> sum;
    const auto add = [&](int axis, int by) {
        const ValueId value = beside(operand, Offset::along(axis, by));
        sum = sum ? builder_.add(*sum, value) : value;
    };
    if (axes_.has(1)) add(1, -1), add(1, 1);
    if (axes_.has(0)) add(0, 1), add(0, -1);
    if (axes_.has(2)) add(2, -1), add(2, 1);
    return *sum;
}

/// (((((N + S) + E) + W) + U) + D − 2n·c) / h² of n axes_.
ValueId Stencils::laplacian(NodeId operand) {
    const double factor = 1 / (grid_.spacing * grid_.spacing);
    if (!graph_.has_mask() && pass_.can_read_as_plane(operand)) {
        return scaled(builder_.laplacian(slot_of_plane(operand)), factor);
    }
    const ValueId sum = sum_of_neighbours(operand);
    const auto neighbours = static_cast<double>(2 * axes_.present.size());
    const ValueId centre = builder_.multiply(builder_.number(neighbours), own(operand));
    // Rounded like the operation on a plane, so that contraction cannot tell which of the two is in
    // use.
    builder_.keep(centre);
    return scaled(builder_.subtract(sum, centre), factor);
}

/// (w (N + S + …) + (NE + …) − 4 (3 n − p) c) / 6h² of n axes and p pairs of axes, with w = 6 − 2
/// (n − 1): 4, 1 and 20 in the plane, 2, 1 and 24 in space (Patra & Karttunen 2006).
ValueId Stencils::isotropic(NodeId operand) {
    const auto n = static_cast<int>(axes_.present.size());
    const int pairs = n * (n - 1) / 2;
    const auto times = [&](int number, ValueId value) {
        return builder_.multiply(builder_.number(number), value);
    };
    ValueId sum = times(8 - 2 * n, sum_of_neighbours(operand));
    std::optional<ValueId> edges;
    for_each_offset(axes_.edges(), [&](Offset offset) {
        const ValueId value = beside(operand, offset);
        edges = edges ? builder_.add(*edges, value) : value;
    });
    if (edges) sum = builder_.add(sum, *edges);
    const ValueId centre = times(4 * (3 * n - pairs), own(operand));
    return scaled(builder_.subtract(sum, centre), 1 / (6 * grid_.spacing * grid_.spacing));
}

/// (E − W) / 2h.
ValueId Stencils::difference(NodeId operand, int axis) {
    if (!axes_.has(axis)) return builder_.number(0);
    const ValueId difference = builder_.subtract(beside(operand, Offset::along(axis, 1)),
                                                 beside(operand, Offset::along(axis, -1)));
    return scaled(difference, 1 / (2 * grid_.spacing));
}

/// ((E + W) − 2c) / h².
ValueId Stencils::second_difference(NodeId operand, int axis) {
    if (!axes_.has(axis)) return builder_.number(0);
    const ValueId sum = builder_.add(beside(operand, Offset::along(axis, 1)),
                                     beside(operand, Offset::along(axis, -1)));
    const ValueId centre = builder_.multiply(builder_.number(2), own(operand));
    return scaled(builder_.subtract(sum, centre), 1 / (grid_.spacing * grid_.spacing));
}

/// ((SE + NW) − (NE + SW)) / 4h².
ValueId Stencils::cross_difference(NodeId operand, int first, int second) {
    if (!axes_.has(first) || !axes_.has(second)) return builder_.number(0);
    const auto corner = [&](int a, int b) {
        return beside(operand, Offset::along(first, a) + Offset::along(second, b));
    };
    const ValueId rising = builder_.add(corner(1, 1), corner(-1, -1));
    const ValueId falling = builder_.add(corner(1, -1), corner(-1, 1));
    return scaled(builder_.subtract(rising, falling), 1 / (4 * grid_.spacing * grid_.spacing));
}

/// The sum of the squares of the central differences, x first.
ValueId Stencils::squared_gradient(NodeId operand) {
    std::optional<ValueId> sum;
    for (const int axis : axes_.present) {
        const ValueId along = difference(operand, axis);
        const ValueId square = builder_.multiply(along, along);
        sum = sum ? builder_.add(*sum, square) : square;
    }
    return sum.value_or(builder_.number(0));
}

/// Σ v · (v > 0 ? c − W : E − c) / h: upwind.
ValueId Stencils::advection(const Node& node) {
    const std::uint32_t velocities = node.operand_count - 1;
    const NodeId operand = node.operands[velocities];
    std::optional<ValueId> sum;
    for (const int axis : axes_.present) {
        if (static_cast<std::uint32_t>(axis) >= velocities) continue;
        const ValueId velocity = own(node.operands[static_cast<std::size_t>(axis)]);
        const ValueId centre = own(operand);
        const ValueId backward =
            builder_.subtract(centre, beside(operand, Offset::along(axis, -1)));
        const ValueId forward = builder_.subtract(beside(operand, Offset::along(axis, 1)), centre);
        const ValueId flows_forwards = builder_.apply(Op::less, builder_.number(0), velocity);
        const ValueId term =
            builder_.multiply(velocity, builder_.select(flows_forwards, backward, forward));
        sum = sum ? builder_.add(*sum, term) : term;
    }
    return scaled(sum.value_or(builder_.number(0)), 1 / grid_.spacing);
}

/// v · (v > 0 ? c − W : E − c) / h along one axis.
ValueId Stencils::upwind(const Node& node) {
    const int axis = std::get<Call>(node.kind).detail;
    const NodeId operand = node.operands[1];
    const ValueId velocity = own(node.operands[0]), centre = own(operand);
    const ValueId backward = builder_.subtract(centre, beside(operand, Offset::along(axis, -1)));
    const ValueId forward = builder_.subtract(beside(operand, Offset::along(axis, 1)), centre);
    const ValueId flows_forwards = builder_.apply(Op::less, builder_.number(0), velocity);
    return scaled(builder_.multiply(velocity, builder_.select(flows_forwards, backward, forward)),
                  1 / grid_.spacing);
}

/// The harmonic mean of a = E − c and b = c − W, 2ab / (a + b), if both have the same sign, else 0
/// (van Leer's limiter).
ValueId Stencils::limited(const Node& node) {
    const int axis = std::get<Call>(node.kind).detail;
    const NodeId operand = node.operands[0];
    const ValueId centre = own(operand), zero = builder_.number(0);
    const ValueId a = builder_.subtract(beside(operand, Offset::along(axis, 1)), centre);
    const ValueId b = builder_.subtract(centre, beside(operand, Offset::along(axis, -1)));
    const ValueId is_monotone = builder_.apply(Op::less, zero, builder_.multiply(a, b));
    const ValueId share = builder_.divide(b, builder_.add(a, b));
    const ValueId mean = builder_.multiply(builder_.multiply(builder_.number(2), a), share);
    return builder_.select(is_monotone, mean, zero);
}

/// a11 ∂²c/∂x² + a22 ∂²c/∂y² + 2 a12 ∂²c/∂x∂y with y down (Witkin & Kass, eq 7).
ValueId Stencils::anisotropic(const Node& node) {
    const Value& tensor = values_.at(node.operands[0], {});
    const NodeId operand = node.operands[1];
    const ValueId along_x = builder_.multiply(tensor[0], second_difference(operand, 0));
    const ValueId along_y = builder_.multiply(tensor[2], second_difference(operand, 1));
    const ValueId across = builder_.multiply(tensor[1], cross_difference(operand, 0, 1));
    return builder_.add(builder_.add(along_x, along_y), scaled(across, 2));
}

}  // namespace

ValueId lower_stencil(const PassView& pass, KernelAssembly& assembly, const NodeValues& values,
                      NodeId id) {
    return Stencils(pass, assembly, values).stencil(pass.graph[id]);
}

}  // namespace cascade::lowering
